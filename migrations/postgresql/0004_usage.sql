-- What made a result, what it used, and who did what. Usage and events outlive jobs and sweeps.

ALTER TABLE jobs ADD COLUMN request_sha256 text;             -- of the canonical request; NULL: stored by an earlier version
ALTER TABLE jobs ADD COLUMN program text;                    -- that computed the outcome, JSON; NULL: none did
ALTER TABLE jobs ADD COLUMN cpu_us bigint;                   -- NULL: nothing was computed
ALTER TABLE jobs ADD COLUMN peak_bytes bigint;
ALTER TABLE jobs ADD COLUMN factorizations bigint;
ALTER TABLE jobs ADD COLUMN key_sha256 text;                 -- of the key that reads this job alone; NULL: none
ALTER TABLE sweeps ADD COLUMN request_sha256 text;
-- Beside the counts, so that workers do not wait for one another.
ALTER TABLE sweep_counts ADD COLUMN program text;
ALTER TABLE sweep_counts ADD COLUMN cpu_us bigint;
ALTER TABLE sweep_counts ADD COLUMN peak_bytes bigint;
ALTER TABLE sweep_counts ADD COLUMN factorizations bigint;

-- What an owner used in an hour is the sum of its rows.
CREATE TABLE usage (
  owner text NOT NULL,
  hour bigint NOT NULL,                                      -- hours since 1970
  label bytea NOT NULL,                                      -- '': work without a label
  slot integer NOT NULL,
  jobs bigint NOT NULL DEFAULT 0,                            -- that ended successful or failed
  points bigint NOT NULL DEFAULT 0,                          -- rows of sweeps
  cpu_us bigint NOT NULL DEFAULT 0,
  peak_bytes bigint NOT NULL DEFAULT 0,
  factorizations bigint NOT NULL DEFAULT 0,
  PRIMARY KEY (owner, hour, label, slot)
) WITH (fillfactor = 50, autovacuum_vacuum_scale_factor = 0, autovacuum_vacuum_threshold = 1000,
        autovacuum_vacuum_cost_delay = 0);

CREATE TABLE audit (
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,    -- order of events
  owner text NOT NULL,
  at_us bigint NOT NULL,
  event text NOT NULL CHECK (event IN ('submitted', 'dismissed', 'retried', 'deleted', 'retired')),
  sweep boolean NOT NULL,
  entry text NOT NULL                                        -- id of the job or sweep
);
CREATE INDEX audit_by_owner ON audit (owner, number);
CREATE INDEX audit_of_deletions ON audit (entry) WHERE event IN ('deleted', 'retired');

-- @param TG_ARGV[0] event @param TG_ARGV[1] whether the table is that of sweeps
CREATE FUNCTION note_event() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  INSERT INTO audit (owner, at_us, event, sweep, entry) VALUES (new.owner,
    CASE TG_ARGV[0] WHEN 'submitted' THEN new.created_us ELSE new.finished_us END, TG_ARGV[0], TG_ARGV[1]::boolean, new.id);
  RETURN NULL;
END $$;
CREATE TRIGGER audit_job_submitted AFTER INSERT ON jobs FOR EACH ROW EXECUTE FUNCTION note_event('submitted', 'false');
CREATE TRIGGER audit_job_dismissed AFTER UPDATE OF status ON jobs FOR EACH ROW
  WHEN (new.status = 'dismissed' AND old.status <> 'dismissed') EXECUTE FUNCTION note_event('dismissed', 'false');
CREATE TRIGGER audit_sweep_submitted AFTER INSERT ON sweeps FOR EACH ROW EXECUTE FUNCTION note_event('submitted', 'true');
CREATE TRIGGER audit_sweep_dismissed AFTER UPDATE OF status ON sweeps FOR EACH ROW
  WHEN (new.status = 'dismissed' AND old.status <> 'dismissed') EXECUTE FUNCTION note_event('dismissed', 'true');
