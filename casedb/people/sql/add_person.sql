-- A person without a name.
INSERT INTO person (
  person_id, pseudonym, created_us
) VALUES (
  :person_id, :pseudonym, :created_us
)
