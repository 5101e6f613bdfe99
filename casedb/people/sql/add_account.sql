-- What a person may do, and how to prove to be that person.
INSERT INTO account (
  person_id, role, password_hash, enabled, created_us
) VALUES (
  :person_id, :role, :password_hash, :enabled, :created_us
)
