-- The capacity of supports is a type of critical point. Only CHECK constraints change, as in 0012.
PRAGMA writable_schema = ON;
UPDATE sqlite_schema SET sql = replace(sql, '''flutter'')', '''flutter'', ''capacity'')')
  WHERE type = 'table' AND name IN ('results', 'critical_points');
CREATE TABLE schema_has_changed (x INTEGER) STRICT;
DROP TABLE schema_has_changed;
PRAGMA writable_schema = RESET;
