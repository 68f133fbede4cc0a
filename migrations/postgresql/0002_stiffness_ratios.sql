-- Least stiffness at each point of a branch over that of the unloaded structure: little-endian float64, NaN where it is
-- not known; null in branches that were stored before.
ALTER TABLE branches ADD COLUMN stiffness_ratio bytea;
