-- A result document that is long goes on here, so that any part of it is read in the same time: a row of
-- SQLite is a chain of pages, which is walked from its beginning.
CREATE TABLE result_pieces (
  seq INTEGER PRIMARY KEY,
  job INTEGER NOT NULL REFERENCES results (job) ON DELETE CASCADE,
  number INTEGER NOT NULL CHECK (number >= 0),   -- results.document comes before 0
  bytes BLOB NOT NULL CHECK (length(bytes) > 0), -- 1 MiB, the last may be shorter
  UNIQUE (job, number)
) STRICT;

CREATE TRIGGER jobs_result_piece_bytes AFTER INSERT ON result_pieces
BEGIN
  UPDATE jobs SET bytes = bytes + length(new.bytes) WHERE seq = new.job;
END;
