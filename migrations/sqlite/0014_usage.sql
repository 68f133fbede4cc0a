-- What made a result, what it used, and who did what. Usage and events outlive jobs and sweeps.

ALTER TABLE jobs ADD COLUMN request_sha256 TEXT;             -- of the canonical request; NULL: stored by an earlier version
ALTER TABLE jobs ADD COLUMN program TEXT;                    -- that computed the outcome, JSON; NULL: none did
ALTER TABLE jobs ADD COLUMN cpu_us INTEGER;                  -- NULL: nothing was computed
ALTER TABLE jobs ADD COLUMN peak_bytes INTEGER;
ALTER TABLE jobs ADD COLUMN factorizations INTEGER;
ALTER TABLE jobs ADD COLUMN key_sha256 TEXT;                 -- of the key that reads this job alone; NULL: none
ALTER TABLE sweeps ADD COLUMN request_sha256 TEXT;
ALTER TABLE sweeps ADD COLUMN program TEXT;
ALTER TABLE sweeps ADD COLUMN cpu_us INTEGER;
ALTER TABLE sweeps ADD COLUMN peak_bytes INTEGER;
ALTER TABLE sweeps ADD COLUMN factorizations INTEGER;

CREATE TABLE usage (
  owner TEXT NOT NULL,
  hour INTEGER NOT NULL,                                     -- hours since 1970
  label TEXT NOT NULL,                                       -- '': work without a label
  jobs INTEGER NOT NULL DEFAULT 0,                           -- that ended successful or failed
  points INTEGER NOT NULL DEFAULT 0,                         -- rows of sweeps
  cpu_us INTEGER NOT NULL DEFAULT 0,
  peak_bytes INTEGER NOT NULL DEFAULT 0,
  factorizations INTEGER NOT NULL DEFAULT 0,
  PRIMARY KEY (owner, hour, label)
) STRICT, WITHOUT ROWID;

CREATE TABLE audit (
  number INTEGER PRIMARY KEY AUTOINCREMENT,                  -- order of events
  owner TEXT NOT NULL,
  at_us INTEGER NOT NULL,
  event TEXT NOT NULL CHECK (event IN ('submitted', 'dismissed', 'retried', 'deleted', 'retired')),
  sweep INTEGER NOT NULL CHECK (sweep IN (0, 1)),
  entry TEXT NOT NULL                                        -- id of the job or sweep
) STRICT;
CREATE INDEX audit_by_owner ON audit (owner, number);
CREATE INDEX audit_of_deletions ON audit (entry) WHERE event IN ('deleted', 'retired');

CREATE TRIGGER audit_job_submitted AFTER INSERT ON jobs
BEGIN
  INSERT INTO audit (owner, at_us, event, sweep, entry) VALUES (new.owner, new.created_us, 'submitted', 0, new.id);
END;
CREATE TRIGGER audit_job_dismissed AFTER UPDATE OF status ON jobs WHEN new.status = 'dismissed'
BEGIN
  INSERT INTO audit (owner, at_us, event, sweep, entry) VALUES (new.owner, new.finished_us, 'dismissed', 0, new.id);
END;
CREATE TRIGGER audit_sweep_submitted AFTER INSERT ON sweeps
BEGIN
  INSERT INTO audit (owner, at_us, event, sweep, entry) VALUES (new.owner, new.created_us, 'submitted', 1, new.id);
END;
CREATE TRIGGER audit_sweep_dismissed AFTER UPDATE OF status ON sweeps
WHEN new.status = 'dismissed' AND old.status <> 'dismissed'
BEGIN
  INSERT INTO audit (owner, at_us, event, sweep, entry) VALUES (new.owner, new.finished_us, 'dismissed', 1, new.id);
END;
