-- One row more.
UPDATE audit_head SET count = :count, hash = :hash
