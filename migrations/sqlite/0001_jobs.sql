-- Jobs, their requests, their results.
-- Times are microseconds since 1970-01-01 UTC. Series are BLOBs of little-endian float64, one value a point.

CREATE TABLE jobs (
  seq INTEGER PRIMARY KEY AUTOINCREMENT,         -- order of arrival, never reused
  id TEXT NOT NULL UNIQUE CHECK (length(id) = 36),
  status TEXT NOT NULL DEFAULT 'accepted'
    CHECK (status IN ('accepted', 'running', 'successful', 'failed', 'dismissed')),
  attempt INTEGER NOT NULL DEFAULT 0 CHECK (attempt >= 0),  -- counts claims; with id and status it fences writes
  crashes INTEGER NOT NULL DEFAULT 0 CHECK (crashes >= 0 AND crashes <= attempt),  -- claims whose process died
  title TEXT NOT NULL DEFAULT '',
  analysis_type TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  started_us INTEGER,                            -- of the latest claim
  finished_us INTEGER,
  CHECK (status IN ('accepted', 'dismissed') OR attempt > 0),
  CHECK ((status = 'accepted') <= (started_us IS NULL)),
  CHECK ((status IN ('running', 'successful', 'failed')) <= (started_us IS NOT NULL)),
  CHECK ((status IN ('successful', 'failed', 'dismissed')) = (finished_us IS NOT NULL))
) STRICT;

CREATE INDEX jobs_waiting ON jobs (seq) WHERE status = 'accepted';
CREATE INDEX jobs_running ON jobs (seq) WHERE status = 'running';
CREATE INDEX jobs_by_status ON jobs (status, seq);

-- The request document as it was received.
CREATE TABLE requests (
  job INTEGER PRIMARY KEY REFERENCES jobs (seq) ON DELETE CASCADE,
  document TEXT NOT NULL
) STRICT;

-- One row exactly when the job's status is 'successful'. The document is served as it is, byte for byte.
CREATE TABLE results (
  job INTEGER PRIMARY KEY REFERENCES jobs (seq) ON DELETE CASCADE,
  document TEXT NOT NULL,
  critical_load_factor REAL,
  critical_type TEXT CHECK (critical_type IN ('bifurcation', 'limit_max', 'limit_min')),
  termination TEXT NOT NULL,
  wall_time_s REAL NOT NULL CHECK (wall_time_s >= 0),
  CHECK ((critical_load_factor IS NULL) = (critical_type IS NULL))
) STRICT;

-- One row exactly when the job's status is 'failed': why, and the result document of what was reached (if any).
CREATE TABLE failures (
  job INTEGER PRIMARY KEY REFERENCES jobs (seq) ON DELETE CASCADE,
  code TEXT NOT NULL CHECK (code <> ''),
  detail TEXT NOT NULL,
  reached TEXT
) STRICT;

CREATE TABLE branches (
  job INTEGER NOT NULL REFERENCES jobs (seq) ON DELETE CASCADE,
  branch INTEGER NOT NULL,
  parent INTEGER,
  points INTEGER NOT NULL CHECK (points >= 0),
  load_factor BLOB NOT NULL CHECK (length(load_factor) = 8 * points),
  arc_length BLOB NOT NULL CHECK (length(arc_length) = 8 * points),
  negative_eigenvalues BLOB NOT NULL CHECK (length(negative_eigenvalues) = 8 * points),
  PRIMARY KEY (job, branch)
) STRICT, WITHOUT ROWID;

CREATE TABLE branch_series (
  job INTEGER NOT NULL,
  branch INTEGER NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('monitor', 'contact_fraction')),
  number INTEGER NOT NULL CHECK (number >= 0),   -- order in the result document
  id TEXT NOT NULL,                              -- of the monitor or the foundation
  samples BLOB NOT NULL CHECK (length(samples) % 8 = 0),
  PRIMARY KEY (job, branch, kind, number),
  FOREIGN KEY (job, branch) REFERENCES branches (job, branch) ON DELETE CASCADE
) STRICT, WITHOUT ROWID;

CREATE TABLE critical_points (
  job INTEGER NOT NULL REFERENCES jobs (seq) ON DELETE CASCADE,
  number INTEGER NOT NULL CHECK (number >= 0),   -- order in the result document
  branch INTEGER NOT NULL,
  type TEXT NOT NULL CHECK (type IN ('bifurcation', 'limit_max', 'limit_min')),
  load_factor REAL NOT NULL,
  error_estimate REAL,
  arc_length REAL NOT NULL,
  negative_before INTEGER NOT NULL,
  negative_after INTEGER NOT NULL,
  multiplicity INTEGER NOT NULL CHECK (multiplicity > 0),
  PRIMARY KEY (job, number)
) STRICT, WITHOUT ROWID;
