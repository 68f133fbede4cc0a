-- Flutter is a type of critical point. Only CHECK constraints change, no stored row: SQLite's documentation (ALTER TABLE,
-- "Making Other Kinds Of Table Schema Changes") has the text of the tables edited then.
PRAGMA writable_schema = ON;
UPDATE sqlite_schema SET sql = replace(sql, '''limit_min'')', '''limit_min'', ''flutter'')')
  WHERE type = 'table' AND name = 'results';
UPDATE sqlite_schema SET sql = replace(sql, '''broken_bifurcation'')', '''broken_bifurcation'', ''flutter'')')
  WHERE type = 'table' AND name = 'critical_points';
CREATE TABLE schema_has_changed (x INTEGER) STRICT;
DROP TABLE schema_has_changed;
PRAGMA writable_schema = RESET;
