-- What is left of a sweep, as runs of units: each unit has rows, or a worker has it, or it is here.
-- A unit is a point, or all points of a curve that is followed.

ALTER TABLE sweeps ADD COLUMN unit_points INTEGER NOT NULL DEFAULT 1 CHECK (unit_points > 0);
UPDATE sweeps SET unit_points = ifnull(
  (SELECT max(1, coalesce(json_array_length(document, '$.parameters[#-1].values'),
                          json_extract(document, '$.parameters[#-1].range.count'), 1))
   FROM sweep_documents WHERE sweep = seq AND json_extract(document, '$.follow') IS NOT NULL), 1);

CREATE TABLE sweep_left (
  sweep INTEGER NOT NULL REFERENCES sweeps (seq) ON DELETE CASCADE,
  first INTEGER NOT NULL CHECK (first >= 0),     -- number of the first unit of the run
  units INTEGER NOT NULL CHECK (units > 0),
  crashes INTEGER NOT NULL DEFAULT 0 CHECK (crashes >= 0),  -- how often a process died that had them
  PRIMARY KEY (sweep, first)
) STRICT, WITHOUT ROWID;

-- Of sweeps that go on, or that may be tried again, the units that lack a row.
INSERT INTO sweep_left (sweep, first, units)
  WITH lacking (sweep, unit) AS (
    SELECT sweep, unit FROM (
      WITH RECURSIVE numbers (sweep, unit, last) AS (
        SELECT seq, 0, points / unit_points - 1 FROM sweeps
          WHERE removed = 0 AND status IN ('accepted', 'running', 'dismissed') AND successful + failed < points
        UNION ALL SELECT sweep, unit + 1, last FROM numbers WHERE unit < last)
      SELECT sweep, unit FROM numbers)
    EXCEPT SELECT sweep, point / unit_points FROM sweep_points JOIN sweeps ON seq = sweep
      GROUP BY 1, 2 HAVING count(*) = unit_points)
  SELECT sweep, min(unit), count(*) FROM (
    SELECT sweep, unit, unit - row_number() OVER (PARTITION BY sweep ORDER BY unit) AS run FROM lacking)
  GROUP BY sweep, run;

DROP TABLE sweep_crashes;
DROP TABLE sweep_claims;
-- Units that a worker has: given out again when their lease has run out, or their process is gone.
CREATE TABLE sweep_claims (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  sweep INTEGER NOT NULL REFERENCES sweeps (seq) ON DELETE CASCADE,
  first INTEGER NOT NULL CHECK (first >= 0),
  units INTEGER NOT NULL CHECK (units > 0),
  crashes INTEGER NOT NULL CHECK (crashes >= 0),
  worker TEXT NOT NULL,
  lease_until_us INTEGER NOT NULL
) STRICT;
CREATE INDEX sweep_claims_by_sweep ON sweep_claims (sweep);

-- Owners take turns: of one owner the oldest job that waits.
DROP INDEX jobs_waiting;
CREATE INDEX jobs_in_turn ON jobs (owner, seq, created_us) WHERE status = 'accepted';

-- Points of sweeps that an owner with a quota of them has handed in or tried again, by minute since 1970; of an hour.
CREATE TABLE owner_points (
  owner TEXT NOT NULL,
  minute INTEGER NOT NULL,
  points INTEGER NOT NULL,
  PRIMARY KEY (owner, minute)
) STRICT, WITHOUT ROWID;
