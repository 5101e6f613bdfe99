-- What was planted in a simulated person.
INSERT INTO simulated_truth (
  person_id, people_version, seed, group_name, number, eye_hand, spatial, planning, conduct, strategy
) VALUES (
  :person_id, :people_version, :seed, :group_name, :number, :eye_hand, :spatial, :planning, :conduct, :strategy
)
