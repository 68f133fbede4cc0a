-- What a client notes on a job or sweep, and an index for each set of filters of a list.

ALTER TABLE jobs ADD COLUMN label TEXT CHECK (label <> '');            -- NULL: none
ALTER TABLE jobs ADD COLUMN metadata TEXT CHECK (metadata <> '');      -- JSON object of texts; NULL: none
ALTER TABLE sweeps ADD COLUMN label TEXT CHECK (label <> '');
ALTER TABLE sweeps ADD COLUMN metadata TEXT CHECK (metadata <> '');
ALTER TABLE sweeps ADD COLUMN analysis_type TEXT NOT NULL DEFAULT '';  -- of the document as it stands
UPDATE sweeps SET analysis_type = ifnull(
  (SELECT json_extract(document, '$.analysis.type') FROM sweep_documents WHERE sweep = seq), '');

-- Lists are in the order of creation, newest first, of one owner. A list of all statuses merges one ordered
-- run for each status, so that no index without the status is needed. Labels cost only who uses them.
DROP INDEX jobs_by_owner;
DROP INDEX jobs_by_status;
DROP INDEX jobs_running;  -- jobs_by_lease finds them
CREATE INDEX jobs_listed ON jobs (owner, status, created_us);
CREATE INDEX jobs_by_analysis ON jobs (owner, analysis_type, status, created_us);
CREATE INDEX jobs_by_label ON jobs (owner, label, status, created_us) WHERE label IS NOT NULL;
CREATE INDEX jobs_by_label_and_analysis ON jobs (owner, label, analysis_type, status, created_us)
  WHERE label IS NOT NULL;

DROP INDEX sweeps_by_owner;
CREATE INDEX sweeps_listed ON sweeps (owner, status, created_us) WHERE removed = 0;
CREATE INDEX sweeps_by_analysis ON sweeps (owner, analysis_type, status, created_us) WHERE removed = 0;
CREATE INDEX sweeps_by_label ON sweeps (owner, label, status, created_us)
  WHERE label IS NOT NULL AND removed = 0;
CREATE INDEX sweeps_by_label_and_analysis ON sweeps (owner, label, analysis_type, status, created_us)
  WHERE label IS NOT NULL AND removed = 0;
