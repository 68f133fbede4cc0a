-- Sweeps: one document, a row for each point that was computed.

CREATE TABLE sweeps (
  seq INTEGER PRIMARY KEY AUTOINCREMENT,         -- order of arrival, never reused
  id TEXT NOT NULL UNIQUE CHECK (length(id) = 36),
  status TEXT NOT NULL DEFAULT 'accepted'
    CHECK (status IN ('accepted', 'running', 'successful', 'failed', 'dismissed')),
  owner TEXT NOT NULL DEFAULT '',
  title TEXT NOT NULL DEFAULT '',
  reuse INTEGER NOT NULL DEFAULT 1 CHECK (reuse IN (0, 1)),      -- rows of other sweeps will do
  removed INTEGER NOT NULL DEFAULT 0 CHECK (removed IN (0, 1)),  -- nobody finds it; its space is given back later
  points INTEGER NOT NULL CHECK (points > 0),
  successful INTEGER NOT NULL DEFAULT 0 CHECK (successful >= 0), -- rows of sweep_points, counted as they come
  failed INTEGER NOT NULL DEFAULT 0 CHECK (failed >= 0),
  reused INTEGER NOT NULL DEFAULT 0 CHECK (reused >= 0 AND reused <= successful),
  created_us INTEGER NOT NULL,
  started_us INTEGER,
  finished_us INTEGER,
  CHECK (successful + failed <= points),
  CHECK ((status IN ('successful', 'failed', 'dismissed')) = (finished_us IS NOT NULL)),
  CHECK (status <> 'successful' OR successful = points),
  CHECK (status <> 'failed' OR (failed > 0 AND successful + failed = points))
) STRICT;
CREATE INDEX sweeps_unfinished ON sweeps (seq) WHERE status IN ('accepted', 'running');
CREATE INDEX sweeps_by_owner ON sweeps (owner, seq);
CREATE INDEX sweeps_by_end ON sweeps (finished_us) WHERE finished_us IS NOT NULL;
CREATE INDEX sweeps_removed ON sweeps (seq) WHERE removed = 1;

CREATE TABLE sweep_documents (
  sweep INTEGER PRIMARY KEY REFERENCES sweeps (seq) ON DELETE CASCADE,
  document TEXT NOT NULL
) STRICT;

-- A point that was solved has outputs, one that failed has a code.
CREATE TABLE sweep_points (
  sweep INTEGER NOT NULL REFERENCES sweeps (seq) ON DELETE CASCADE,
  point INTEGER NOT NULL CHECK (point >= 0),
  outputs TEXT,                                  -- JSON array
  code TEXT,
  detail TEXT,
  content_key TEXT,                              -- of owner, canonical request, outputs, version
  PRIMARY KEY (sweep, point),
  CHECK ((outputs IS NULL) = (code IS NOT NULL)),
  CHECK ((code IS NULL) = (detail IS NULL))
) STRICT, WITHOUT ROWID;
CREATE INDEX sweep_points_by_content ON sweep_points (content_key) WHERE outputs IS NOT NULL;
CREATE INDEX sweep_points_failed ON sweep_points (sweep, point) WHERE code IS NOT NULL;

-- Points that a worker has at this moment: what is here at a start was left by a process that died.
CREATE TABLE sweep_claims (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  sweep INTEGER NOT NULL REFERENCES sweeps (seq) ON DELETE CASCADE,
  points BLOB NOT NULL CHECK (length(points) % 8 = 0)  -- numbers as little-endian float64
) STRICT;
CREATE INDEX sweep_claims_by_sweep ON sweep_claims (sweep);

CREATE TABLE sweep_crashes (
  sweep INTEGER NOT NULL REFERENCES sweeps (seq) ON DELETE CASCADE,
  point INTEGER NOT NULL,
  crashes INTEGER NOT NULL CHECK (crashes > 0),
  PRIMARY KEY (sweep, point)
) STRICT, WITHOUT ROWID;

CREATE TABLE sweep_keys (
  owner TEXT NOT NULL,
  key TEXT NOT NULL,
  fingerprint TEXT NOT NULL,                     -- of the body it came with
  sweep INTEGER NOT NULL REFERENCES sweeps (seq) ON DELETE CASCADE,
  created_us INTEGER NOT NULL,
  PRIMARY KEY (owner, key)
) STRICT, WITHOUT ROWID;
CREATE INDEX sweep_keys_by_sweep ON sweep_keys (sweep);
