-- What each owner has waiting and keeps, counted as it changes: a quota needs no scan.

-- Of the documents that belong to it. What an earlier version stored counts as 0: to measure it would take a scan.
ALTER TABLE jobs ADD COLUMN bytes INTEGER NOT NULL DEFAULT 0 CHECK (bytes >= 0);
ALTER TABLE sweeps ADD COLUMN bytes INTEGER NOT NULL DEFAULT 0 CHECK (bytes >= 0);
ALTER TABLE sweeps ADD COLUMN waiting INTEGER GENERATED ALWAYS AS  -- points without a row that will get one
  (iif(removed = 0 AND status IN ('accepted', 'running'), points - successful - failed, 0)) VIRTUAL;
ALTER TABLE sweeps ADD COLUMN kept INTEGER GENERATED ALWAYS AS (iif(removed = 0, bytes, 0)) VIRTUAL;

CREATE TABLE owners (
  owner TEXT PRIMARY KEY,
  jobs_waiting INTEGER NOT NULL DEFAULT 0,       -- accepted jobs
  points_waiting INTEGER NOT NULL DEFAULT 0,     -- the sum of sweeps.waiting
  bytes_kept INTEGER NOT NULL DEFAULT 0          -- the sum of jobs.bytes and sweeps.kept
) STRICT, WITHOUT ROWID;
INSERT INTO owners (owner, jobs_waiting)
  SELECT owner, sum(status = 'accepted') FROM jobs WHERE status IN ('accepted', 'running') GROUP BY owner;
INSERT INTO owners (owner, points_waiting)
  SELECT owner, sum(waiting) FROM sweeps WHERE removed = 0 GROUP BY owner
  ON CONFLICT (owner) DO UPDATE SET points_waiting = excluded.points_waiting;

CREATE TRIGGER owners_job_added AFTER INSERT ON jobs
BEGIN
  INSERT INTO owners (owner, jobs_waiting) VALUES (new.owner, new.status = 'accepted')
    ON CONFLICT (owner) DO UPDATE SET jobs_waiting = jobs_waiting + excluded.jobs_waiting;
END;
CREATE TRIGGER owners_job_changed AFTER UPDATE OF status, bytes ON jobs
WHEN (old.status = 'accepted') <> (new.status = 'accepted') OR old.bytes <> new.bytes
BEGIN
  UPDATE owners SET jobs_waiting = jobs_waiting + (new.status = 'accepted') - (old.status = 'accepted'),
    bytes_kept = bytes_kept + new.bytes - old.bytes WHERE owner = new.owner;
END;
CREATE TRIGGER owners_job_removed AFTER DELETE ON jobs
BEGIN
  UPDATE owners SET jobs_waiting = jobs_waiting - (old.status = 'accepted'), bytes_kept = bytes_kept - old.bytes
    WHERE owner = old.owner;
END;

CREATE TRIGGER owners_sweep_added AFTER INSERT ON sweeps
BEGIN
  INSERT INTO owners (owner, points_waiting) VALUES (new.owner, new.waiting)
    ON CONFLICT (owner) DO UPDATE SET points_waiting = points_waiting + excluded.points_waiting;
END;
CREATE TRIGGER owners_sweep_changed AFTER UPDATE OF status, successful, failed, removed, bytes ON sweeps
WHEN old.waiting <> new.waiting OR old.kept <> new.kept
BEGIN
  UPDATE owners SET points_waiting = points_waiting + new.waiting - old.waiting,
    bytes_kept = bytes_kept + new.kept - old.kept WHERE owner = new.owner;
END;
CREATE TRIGGER owners_sweep_removed AFTER DELETE ON sweeps WHEN old.removed = 0
BEGIN
  UPDATE owners SET points_waiting = points_waiting - old.waiting, bytes_kept = bytes_kept - old.kept
    WHERE owner = old.owner;
END;

-- The rows of a sweep are counted where the verbs count them anyway.
CREATE TRIGGER jobs_request_bytes AFTER INSERT ON requests
BEGIN
  UPDATE jobs SET bytes = bytes + length(CAST(new.document AS BLOB)) WHERE seq = new.job;
END;
CREATE TRIGGER jobs_result_bytes AFTER INSERT ON results
BEGIN
  UPDATE jobs SET bytes = bytes + length(CAST(new.document AS BLOB)) WHERE seq = new.job;
END;
CREATE TRIGGER jobs_reached_bytes AFTER INSERT ON failures WHEN new.reached IS NOT NULL
BEGIN
  UPDATE jobs SET bytes = bytes + length(CAST(new.reached AS BLOB)) WHERE seq = new.job;
END;
CREATE TRIGGER sweeps_document_bytes AFTER INSERT ON sweep_documents
BEGIN
  UPDATE sweeps SET bytes = bytes + length(CAST(new.document AS BLOB)) WHERE seq = new.sweep;
END;
