-- The fields of a critical point and of a branch that have no column, as a JSON object by the names of the result document;
-- null in rows that were stored before and where there are none.
ALTER TABLE critical_points ADD COLUMN fields TEXT;
ALTER TABLE branches ADD COLUMN fields TEXT;
