-- Bifurcations that a path passes by for an imperfection, and its size.
CREATE TABLE critical_points_with_imperfection (
  job INTEGER NOT NULL REFERENCES jobs (seq) ON DELETE CASCADE,
  number INTEGER NOT NULL CHECK (number >= 0),   -- order in the result document
  branch INTEGER NOT NULL,
  type TEXT NOT NULL CHECK (type IN ('bifurcation', 'limit_max', 'limit_min', 'broken_bifurcation')),
  load_factor REAL NOT NULL,
  error_estimate REAL,
  arc_length REAL NOT NULL,
  negative_before INTEGER NOT NULL,
  negative_after INTEGER NOT NULL,
  multiplicity INTEGER NOT NULL CHECK (multiplicity > 0),
  imperfection REAL CHECK (imperfection >= 0),   -- of a bifurcation, where it was measured
  PRIMARY KEY (job, number)
) STRICT, WITHOUT ROWID;
INSERT INTO critical_points_with_imperfection
  SELECT job, number, branch, type, load_factor, error_estimate, arc_length, negative_before, negative_after,
    multiplicity, NULL
  FROM critical_points;
DROP TABLE critical_points;
ALTER TABLE critical_points_with_imperfection RENAME TO critical_points;
