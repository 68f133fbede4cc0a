-- Callbacks: the end of a job or sweep is a row here until its receiver has taken the news. Triggers write it
-- with the end itself, whatever verb ends the job.

ALTER TABLE jobs ADD COLUMN callback TEXT CHECK (callback <> '');    -- address; NULL: none
ALTER TABLE sweeps ADD COLUMN callback TEXT CHECK (callback <> '');

CREATE TABLE deliveries (
  number INTEGER PRIMARY KEY AUTOINCREMENT,      -- never reused: names the message for its receiver
  job INTEGER UNIQUE REFERENCES jobs (seq) ON DELETE CASCADE,
  sweep INTEGER UNIQUE REFERENCES sweeps (seq) ON DELETE CASCADE,
  address TEXT NOT NULL,
  origin TEXT NOT NULL GENERATED ALWAYS AS       -- "https://host:port", of "https://host:port/..."
    (substr(address, 1, instr(substr(address, 9), '/') + 7)) VIRTUAL,
  attempts INTEGER NOT NULL DEFAULT 0 CHECK (attempts >= 0),  -- that failed
  due_us INTEGER NOT NULL,
  CHECK ((job IS NULL) <> (sweep IS NULL))
) STRICT;
CREATE INDEX deliveries_due ON deliveries (origin, due_us);

CREATE TRIGGER deliveries_job_ended AFTER UPDATE OF status ON jobs
WHEN new.callback IS NOT NULL AND old.finished_us IS NULL AND new.finished_us IS NOT NULL
BEGIN
  INSERT INTO deliveries (job, address, due_us) VALUES (new.seq, new.callback, new.finished_us);
END;
CREATE TRIGGER deliveries_sweep_ended AFTER UPDATE OF status ON sweeps
WHEN new.callback IS NOT NULL AND old.finished_us IS NULL AND new.finished_us IS NOT NULL AND new.removed = 0
BEGIN
  INSERT INTO deliveries (sweep, address, due_us) VALUES (new.seq, new.callback, new.finished_us);
END;
-- One that is tried again ends again; of one that is removed nobody is told.
CREATE TRIGGER deliveries_sweep_reopened AFTER UPDATE OF status, removed ON sweeps
WHEN new.callback IS NOT NULL AND (new.finished_us IS NULL OR new.removed = 1)
BEGIN
  DELETE FROM deliveries WHERE sweep = new.seq;
END;
