-- Jobs, sweeps, what they leave, and who works on them. Times are microseconds since 1970-01-01 UTC by the
-- database's clock. What users write is kept as bytes (text has no place for a zero byte).
--
-- What changes often is small and apart from what is large and does not change: a row that is updated is
-- written anew, and what is held open elsewhere keeps the old one.

CREATE FUNCTION snapthrough_now() RETURNS bigint LANGUAGE sql VOLATILE
  AS $$ SELECT (extract(epoch FROM clock_timestamp()) * 1000000)::bigint $$;

CREATE TABLE jobs (
  seq bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,  -- order of arrival, about
  id text NOT NULL UNIQUE CHECK (length(id) = 36),
  status text NOT NULL DEFAULT 'accepted'
    CHECK (status IN ('accepted', 'running', 'successful', 'failed', 'dismissed')),
  attempt integer NOT NULL DEFAULT 0 CHECK (attempt >= 0),  -- counts claims; with id and status it fences writes
  crashes integer NOT NULL DEFAULT 0 CHECK (crashes >= 0 AND crashes <= attempt),
  title bytea NOT NULL DEFAULT '',
  analysis_type text NOT NULL,
  created_us bigint NOT NULL,
  started_us bigint,                                 -- of the latest claim
  finished_us bigint,
  owner text NOT NULL DEFAULT '',
  content_key text NOT NULL DEFAULT '',
  label bytea,
  metadata bytea,
  callback text CHECK (callback <> ''),
  bytes bigint NOT NULL DEFAULT 0 CHECK (bytes >= 0),  -- of the documents that belong to it
  CHECK (status IN ('accepted', 'dismissed') OR attempt > 0),
  CHECK (status <> 'accepted' OR started_us IS NULL),
  CHECK (status NOT IN ('running', 'successful', 'failed') OR started_us IS NOT NULL),
  CHECK ((status IN ('successful', 'failed', 'dismissed')) = (finished_us IS NOT NULL))
) WITH (fillfactor = 70, autovacuum_vacuum_scale_factor = 0.02, autovacuum_vacuum_cost_delay = 0);
CREATE INDEX jobs_waiting ON jobs (owner, seq) WHERE status = 'accepted';
CREATE INDEX jobs_by_content ON jobs (content_key, owner) WHERE status = 'successful' AND content_key <> '';
CREATE INDEX jobs_by_end ON jobs (finished_us) WHERE finished_us IS NOT NULL;
CREATE INDEX jobs_listed ON jobs (owner, status, created_us DESC, seq DESC);
CREATE INDEX jobs_by_label ON jobs (owner, label, status, created_us DESC, seq DESC) WHERE label IS NOT NULL;

-- One row exactly for each running job: who has it, and until when.
CREATE TABLE job_leases (
  job bigint PRIMARY KEY REFERENCES jobs (seq) ON DELETE CASCADE,
  worker text NOT NULL,
  until_us bigint NOT NULL
) WITH (fillfactor = 50, autovacuum_vacuum_scale_factor = 0, autovacuum_vacuum_threshold = 1000,
        autovacuum_vacuum_cost_delay = 0);

-- Where running analyses stand, for other hosts; lost when the database crashes.
CREATE UNLOGGED TABLE job_progress (
  job bigint PRIMARY KEY,
  attempt integer NOT NULL,
  number bigint NOT NULL,                            -- how often it told something in this attempt
  branch integer NOT NULL,
  step integer NOT NULL,
  load_factor double precision NOT NULL,
  negative_eigenvalues integer NOT NULL
) WITH (fillfactor = 50);

CREATE TABLE requests (
  job bigint PRIMARY KEY REFERENCES jobs (seq) ON DELETE CASCADE,
  document bytea NOT NULL
);

-- One row exactly when the job's status is 'successful'.
CREATE TABLE results (
  job bigint PRIMARY KEY REFERENCES jobs (seq) ON DELETE CASCADE,
  size bigint NOT NULL,                              -- bytes of the document
  packed boolean NOT NULL,                           -- each piece is a frame of zstd
  critical_load_factor double precision,
  critical_type text,
  termination text NOT NULL,
  wall_time_s double precision NOT NULL
);
-- The result document, of which any part is read in the same time: 1 MiB a piece, the last may be shorter.
CREATE TABLE result_pieces (
  job bigint NOT NULL REFERENCES results (job) ON DELETE CASCADE,
  number integer NOT NULL CHECK (number >= 0),
  bytes bytea NOT NULL,
  PRIMARY KEY (job, number)
);

-- One row exactly when the job's status is 'failed'.
CREATE TABLE failures (
  job bigint PRIMARY KEY REFERENCES jobs (seq) ON DELETE CASCADE,
  code text NOT NULL CHECK (code <> ''),
  detail bytea NOT NULL,
  reached bytea
);

-- Series are little-endian float64, one value a point.
CREATE TABLE branches (
  job bigint NOT NULL REFERENCES jobs (seq) ON DELETE CASCADE,
  branch integer NOT NULL,
  parent integer,
  load_factor bytea NOT NULL,
  arc_length bytea NOT NULL,
  negative_eigenvalues bytea NOT NULL,
  PRIMARY KEY (job, branch)
);
CREATE TABLE branch_series (
  job bigint NOT NULL,
  branch integer NOT NULL,
  kind text NOT NULL CHECK (kind IN ('monitor', 'contact_fraction')),
  number integer NOT NULL CHECK (number >= 0),
  id bytea NOT NULL,                                 -- of the monitor or the foundation
  samples bytea NOT NULL,
  PRIMARY KEY (job, branch, kind, number),
  FOREIGN KEY (job, branch) REFERENCES branches (job, branch) ON DELETE CASCADE
);
CREATE TABLE critical_points (
  job bigint NOT NULL REFERENCES jobs (seq) ON DELETE CASCADE,
  number integer NOT NULL CHECK (number >= 0),
  branch integer NOT NULL,
  type text NOT NULL,
  load_factor double precision NOT NULL,
  error_estimate double precision,
  arc_length double precision NOT NULL,
  negative_before integer NOT NULL,
  negative_after integer NOT NULL,
  multiplicity integer NOT NULL CHECK (multiplicity > 0),
  imperfection double precision,
  PRIMARY KEY (job, number)
);

CREATE TABLE idempotency_keys (
  owner text NOT NULL,
  key text NOT NULL,
  fingerprint text NOT NULL,                         -- of the body it came with
  job bigint NOT NULL REFERENCES jobs (seq) ON DELETE CASCADE,
  created_us bigint NOT NULL,
  PRIMARY KEY (owner, key)
);
CREATE INDEX idempotency_keys_by_job ON idempotency_keys (job);

CREATE TABLE sweeps (
  seq bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  id text NOT NULL UNIQUE CHECK (length(id) = 36),
  status text NOT NULL DEFAULT 'accepted'
    CHECK (status IN ('accepted', 'running', 'successful', 'failed', 'dismissed')),
  owner text NOT NULL DEFAULT '',
  title bytea NOT NULL DEFAULT '',
  analysis_type text NOT NULL DEFAULT '',
  reuse boolean NOT NULL DEFAULT true,               -- rows of other sweeps will do
  removed boolean NOT NULL DEFAULT false,            -- nobody finds it; its space is given back later
  points bigint NOT NULL CHECK (points > 0),
  unit_points bigint NOT NULL DEFAULT 1 CHECK (unit_points > 0),
  created_us bigint NOT NULL,
  started_us bigint,
  finished_us bigint,
  label bytea,
  metadata bytea,
  callback text CHECK (callback <> ''),
  CHECK ((status IN ('successful', 'failed', 'dismissed')) = (finished_us IS NOT NULL))
);
CREATE INDEX sweeps_unfinished ON sweeps (seq) WHERE status IN ('accepted', 'running') AND NOT removed;
CREATE INDEX sweeps_listed ON sweeps (owner, status, created_us DESC, seq DESC) WHERE NOT removed;
CREATE INDEX sweeps_by_end ON sweeps (finished_us) WHERE finished_us IS NOT NULL AND NOT removed;
CREATE INDEX sweeps_removed ON sweeps (seq) WHERE removed;

CREATE TABLE sweep_documents (
  sweep bigint PRIMARY KEY REFERENCES sweeps (seq) ON DELETE CASCADE,
  document bytea NOT NULL
);

-- Units that nobody has. A unit has rows, or a worker has it, or it is here.
CREATE TABLE sweep_left (
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  sweep bigint NOT NULL REFERENCES sweeps (seq) ON DELETE CASCADE,
  first bigint NOT NULL CHECK (first >= 0),
  units bigint NOT NULL CHECK (units > 0),
  crashes integer NOT NULL DEFAULT 0 CHECK (crashes >= 0)
) WITH (fillfactor = 50, autovacuum_vacuum_scale_factor = 0, autovacuum_vacuum_threshold = 1000,
        autovacuum_vacuum_cost_delay = 0);
CREATE INDEX sweep_left_in_order ON sweep_left (sweep, crashes, number);

-- Units that a worker has.
CREATE TABLE sweep_leases (
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,  -- never used again: it fences writes
  sweep bigint NOT NULL REFERENCES sweeps (seq) ON DELETE CASCADE,
  first bigint NOT NULL CHECK (first >= 0),
  units bigint NOT NULL CHECK (units > 0),
  crashes integer NOT NULL CHECK (crashes >= 0),
  worker text NOT NULL,
  until_us bigint NOT NULL
) WITH (fillfactor = 50, autovacuum_vacuum_scale_factor = 0, autovacuum_vacuum_threshold = 1000,
        autovacuum_vacuum_cost_delay = 0);
CREATE INDEX sweep_leases_by_sweep ON sweep_leases (sweep);

-- What came of the units of one lease: what of them is computed later is added to it.
CREATE TABLE sweep_rows (
  sweep bigint NOT NULL REFERENCES sweeps (seq) ON DELETE CASCADE,
  first bigint NOT NULL CHECK (first >= 0),          -- point
  points bigint NOT NULL CHECK (points > 0),         -- from there on, with a row or not
  failed integer NOT NULL CHECK (failed >= 0),       -- rows with a code
  keys bigint[] NOT NULL,                            -- of rows that may be used elsewhere: 64 bits of each key
  rows bytea NOT NULL,                               -- CBOR in a frame of zstd
  PRIMARY KEY (sweep, first)
);
ALTER TABLE sweep_rows ALTER COLUMN rows SET STORAGE EXTERNAL;
-- Not first into a list: who looks for a key would have to read the whole of it.
CREATE INDEX sweep_rows_by_key ON sweep_rows USING gin (keys) WITH (fastupdate = off);

-- Counts of a sweep are the sums of its rows here: several, so that workers do not wait for one another.
CREATE TABLE sweep_counts (
  sweep bigint NOT NULL REFERENCES sweeps (seq) ON DELETE CASCADE,
  slot integer NOT NULL,
  owner text NOT NULL,
  successful bigint NOT NULL DEFAULT 0,
  failed bigint NOT NULL DEFAULT 0,
  reused bigint NOT NULL DEFAULT 0,
  bytes bigint NOT NULL DEFAULT 0,
  PRIMARY KEY (sweep, slot)
) WITH (fillfactor = 50, autovacuum_vacuum_scale_factor = 0, autovacuum_vacuum_threshold = 1000,
        autovacuum_vacuum_cost_delay = 0);

CREATE TABLE sweep_keys (
  owner text NOT NULL,
  key text NOT NULL,
  fingerprint text NOT NULL,
  sweep bigint NOT NULL REFERENCES sweeps (seq) ON DELETE CASCADE,
  created_us bigint NOT NULL,
  PRIMARY KEY (owner, key)
);
CREATE INDEX sweep_keys_by_sweep ON sweep_keys (sweep);
CREATE INDEX sweep_keys_by_age ON sweep_keys (created_us);

-- Points of sweeps that an owner with a quota of them has handed in or tried again, by minute since 1970; of an hour.
CREATE TABLE owner_points (
  owner text NOT NULL,
  minute bigint NOT NULL,
  points bigint NOT NULL,
  PRIMARY KEY (owner, minute)
);

-- Bytes that each owner keeps: the sum of its rows.
CREATE TABLE owner_bytes (
  owner text NOT NULL,
  slot integer NOT NULL,
  bytes bigint NOT NULL,
  PRIMARY KEY (owner, slot)
) WITH (fillfactor = 50, autovacuum_vacuum_scale_factor = 0, autovacuum_vacuum_threshold = 1000,
        autovacuum_vacuum_cost_delay = 0);
CREATE FUNCTION keep_bytes() RETURNS trigger LANGUAGE plpgsql AS $$
DECLARE
  difference bigint := 0;
BEGIN
  IF TG_OP <> 'DELETE' THEN difference := new.bytes; END IF;
  IF TG_OP <> 'INSERT' THEN difference := difference - old.bytes; END IF;
  IF difference <> 0 THEN
    INSERT INTO owner_bytes AS kept VALUES
      (CASE WHEN TG_OP = 'DELETE' THEN old.owner ELSE new.owner END, pg_backend_pid() % 16, difference)
      ON CONFLICT (owner, slot) DO UPDATE SET bytes = kept.bytes + excluded.bytes;
  END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER jobs_bytes AFTER INSERT OR DELETE ON jobs FOR EACH ROW EXECUTE FUNCTION keep_bytes();
CREATE TRIGGER jobs_bytes_changed AFTER UPDATE OF bytes ON jobs
  FOR EACH ROW WHEN (old.bytes <> new.bytes) EXECUTE FUNCTION keep_bytes();
CREATE TRIGGER sweep_bytes AFTER INSERT OR DELETE ON sweep_counts FOR EACH ROW EXECUTE FUNCTION keep_bytes();
CREATE TRIGGER sweep_bytes_changed AFTER UPDATE OF bytes ON sweep_counts
  FOR EACH ROW WHEN (old.bytes <> new.bytes) EXECUTE FUNCTION keep_bytes();

-- The same rows as kJobTransitions in server/jobs/state.h; a test compares them.
CREATE TABLE job_transitions (
  event text NOT NULL,
  from_status text NOT NULL,
  to_status text NOT NULL,
  PRIMARY KEY (event, from_status)
);
INSERT INTO job_transitions (event, from_status, to_status) VALUES
  ('claim', 'accepted', 'running'),
  ('finish', 'running', 'successful'),
  ('fail', 'running', 'failed'),
  ('requeue', 'running', 'accepted'),
  ('dismiss', 'accepted', 'dismissed'),
  ('dismiss', 'running', 'dismissed');
CREATE FUNCTION check_transition() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF NOT EXISTS (SELECT 1 FROM job_transitions WHERE from_status = old.status AND to_status = new.status) THEN
    RAISE EXCEPTION 'a job cannot change from % to %', old.status, new.status;
  END IF;
  RETURN new;
END $$;
CREATE TRIGGER jobs_legal_transition BEFORE UPDATE OF status ON jobs
  FOR EACH ROW WHEN (old.status IS DISTINCT FROM new.status) EXECUTE FUNCTION check_transition();

-- Callbacks: the end of a job or sweep is a row here until its receiver has taken the news.
CREATE TABLE deliveries (
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,  -- never used again: names the message for its receiver
  job bigint UNIQUE REFERENCES jobs (seq) ON DELETE CASCADE,
  sweep bigint UNIQUE REFERENCES sweeps (seq) ON DELETE CASCADE,
  address text NOT NULL,
  origin text NOT NULL GENERATED ALWAYS AS           -- "https://host:port", of "https://host:port/..."
    (substr(address, 1, strpos(substr(address, 9), '/') + 7)) STORED,
  attempts integer NOT NULL DEFAULT 0 CHECK (attempts >= 0),  -- that failed
  due_us bigint NOT NULL,
  CHECK ((job IS NULL) <> (sweep IS NULL))
);
CREATE INDEX deliveries_due ON deliveries (origin, due_us);

CREATE FUNCTION tell_job_end() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  INSERT INTO deliveries (job, address, due_us) VALUES (new.seq, new.callback, new.finished_us);
  RETURN NULL;
END $$;
CREATE TRIGGER deliveries_job_ended AFTER UPDATE OF status ON jobs FOR EACH ROW
  WHEN (new.callback IS NOT NULL AND old.finished_us IS NULL AND new.finished_us IS NOT NULL)
  EXECUTE FUNCTION tell_job_end();
-- One that is tried again ends again; of one that is removed nobody is told.
CREATE FUNCTION tell_sweep_end() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF new.finished_us IS NULL OR new.removed THEN
    DELETE FROM deliveries WHERE sweep = new.seq;
  ELSIF old.finished_us IS NULL THEN
    INSERT INTO deliveries (sweep, address, due_us) VALUES (new.seq, new.callback, new.finished_us);
  END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER deliveries_sweep_ended AFTER UPDATE OF status, removed ON sweeps FOR EACH ROW
  WHEN (new.callback IS NOT NULL) EXECUTE FUNCTION tell_sweep_end();

-- The row of a running job that an attempt still has, locked; raises ST001 when it has it no more.
-- @param now_us its lease must not have run out then; NULL: that does not matter
CREATE FUNCTION held_job(job_id text, job_attempt bigint, now_us bigint) RETURNS bigint LANGUAGE plpgsql AS $$
DECLARE
  found_seq bigint;
BEGIN
  SELECT seq INTO found_seq FROM jobs JOIN job_leases ON job = seq
    WHERE id = job_id AND attempt = job_attempt AND status = 'running' AND (now_us IS NULL OR until_us >= now_us)
    FOR UPDATE OF jobs;
  IF NOT FOUND THEN
    RAISE EXCEPTION 'job % is no longer running in attempt %', job_id, job_attempt USING ERRCODE = 'ST001';
  END IF;
  RETURN found_seq;
END $$;

-- To be called before claims of a sweep are ended, in order of sweeps; lasts as long as the transaction. While units are
-- left that nobody has, many may end claims at a time: the last is another's. When none is left, each has the sweep alone,
-- after all before are done: so the last of them sees that nothing is left. Returns whether the caller has it alone; raises
-- 40001, to be tried again, where the last units were taken before it had its share of the lock. (By the index whatever the
-- planner thinks: where one sweep has most of what is left, it would read the table for the others.)
CREATE FUNCTION hold_claims(sweep_row bigint) RETURNS boolean LANGUAGE plpgsql SET enable_seqscan = off AS $$
DECLARE
  key integer := sweep_row % 2147483647;
BEGIN
  IF NOT EXISTS (SELECT FROM sweep_left WHERE sweep = sweep_row) THEN
    PERFORM pg_advisory_xact_lock(1, key);
    RETURN true;
  END IF;
  PERFORM pg_advisory_xact_lock_shared(1, key);
  IF NOT EXISTS (SELECT FROM sweep_left WHERE sweep = sweep_row) THEN
    RAISE EXCEPTION 'the last units of a sweep were taken at this moment' USING ERRCODE = '40001';
  END IF;
  RETURN false;
END $$;

-- Gives units of a sweep to a worker: the first that nobody has; those with which a process died come last and
-- in smaller numbers, see server/store/crashes.h. No row when others have all that is left; raises ST001 when the sweep is over.
CREATE FUNCTION claim_units(sweep_id text, most bigint, new_worker text, lease_us bigint, now_us bigint)
  RETURNS TABLE (claim_number bigint, claim_first bigint, claim_units bigint) LANGUAGE plpgsql AS $$
DECLARE
  place record;
  run record;
  taken bigint;
BEGIN
  UPDATE sweeps SET status = 'running', started_us = coalesce(started_us, now_us)
    WHERE id = sweep_id AND status = 'accepted' AND NOT removed;
  -- Who dismisses it waits for this claim, and finds it.
  SELECT seq INTO place FROM sweeps WHERE id = sweep_id AND status = 'running' AND NOT removed FOR SHARE;
  IF NOT FOUND THEN
    RAISE EXCEPTION 'sweep % is over', sweep_id USING ERRCODE = 'ST001';
  END IF;
  SELECT number, first, units, crashes INTO run FROM sweep_left WHERE sweep = place.seq
    ORDER BY crashes, number LIMIT 1 FOR UPDATE;
  IF NOT FOUND THEN
    RETURN;
  END IF;
  taken := least(greatest(1, most >> least(63, 6 * run.crashes)), run.units);
  IF taken < run.units THEN
    UPDATE sweep_left SET first = first + taken, units = units - taken WHERE number = run.number;
  ELSE
    DELETE FROM sweep_left WHERE number = run.number;
  END IF;
  RETURN QUERY INSERT INTO sweep_leases (sweep, first, units, crashes, worker, until_us)
    VALUES (place.seq, run.first, taken, run.crashes, new_worker, now_us + lease_us)
    RETURNING number, run.first, taken;
END $$;
