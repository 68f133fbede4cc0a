-- Leases, owners, reuse of results, idempotency keys, and the table of legal transitions as a constraint.

ALTER TABLE jobs ADD COLUMN owner TEXT NOT NULL DEFAULT '';  -- name of the key that handed it in; '' without keys
ALTER TABLE jobs ADD COLUMN content_key TEXT NOT NULL DEFAULT '';  -- of the canonical request and the version; '' unknown
ALTER TABLE jobs ADD COLUMN worker TEXT;                     -- which instance of the service has the latest claim
ALTER TABLE jobs ADD COLUMN lease_until_us INTEGER;          -- the claim holds until then unless it is renewed

-- A claim of a version without leases has no time: its process is gone, the next start takes it back.
UPDATE jobs SET lease_until_us = 0, worker = '' WHERE status = 'running';

CREATE INDEX jobs_by_content ON jobs (content_key, owner) WHERE status = 'successful' AND content_key <> '';
CREATE INDEX jobs_by_lease ON jobs (lease_until_us) WHERE status = 'running';
CREATE INDEX jobs_by_end ON jobs (finished_us) WHERE finished_us IS NOT NULL;
CREATE INDEX jobs_by_owner ON jobs (owner, seq);

CREATE TABLE idempotency_keys (
  owner TEXT NOT NULL,
  key TEXT NOT NULL,
  fingerprint TEXT NOT NULL,                                 -- of the body it came with
  job INTEGER NOT NULL REFERENCES jobs (seq) ON DELETE CASCADE,
  created_us INTEGER NOT NULL,
  PRIMARY KEY (owner, key)
) STRICT, WITHOUT ROWID;
CREATE INDEX idempotency_keys_by_job ON idempotency_keys (job);

-- The same rows as kJobTransitions in server/jobs/state.h; a test compares them.
CREATE TABLE job_transitions (
  event TEXT NOT NULL,
  from_status TEXT NOT NULL,
  to_status TEXT NOT NULL,
  PRIMARY KEY (event, from_status)
) STRICT, WITHOUT ROWID;
INSERT INTO job_transitions (event, from_status, to_status) VALUES
  ('claim', 'accepted', 'running'),
  ('finish', 'running', 'successful'),
  ('fail', 'running', 'failed'),
  ('requeue', 'running', 'accepted'),
  ('dismiss', 'accepted', 'dismissed'),
  ('dismiss', 'running', 'dismissed');

CREATE TRIGGER jobs_legal_transition BEFORE UPDATE OF status ON jobs
WHEN NOT EXISTS (SELECT 1 FROM job_transitions WHERE from_status = old.status AND to_status = new.status)
BEGIN
  SELECT RAISE(ABORT, 'a job cannot change from this status to that');
END;
CREATE TRIGGER jobs_running_has_lease BEFORE UPDATE OF status ON jobs
WHEN new.status = 'running' AND (new.lease_until_us IS NULL OR new.worker IS NULL)
BEGIN
  SELECT RAISE(ABORT, 'a running job needs a worker and a lease');
END;
CREATE TRIGGER jobs_successful_has_result BEFORE UPDATE OF status ON jobs
WHEN new.status = 'successful' AND NOT EXISTS (SELECT 1 FROM results WHERE job = new.seq)
BEGIN
  SELECT RAISE(ABORT, 'a successful job needs a result');
END;
CREATE TRIGGER results_only_when_running BEFORE INSERT ON results
WHEN (SELECT status FROM jobs WHERE seq = new.job) IS NOT 'running'
BEGIN
  SELECT RAISE(ABORT, 'only a running job gets a result');
END;

-- One row, written to find out whether writing works.
CREATE TABLE probes (
  number INTEGER PRIMARY KEY CHECK (number = 1),
  at_us INTEGER NOT NULL
) STRICT;
