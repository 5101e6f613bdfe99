-- What was planted in everybody who was simulated.
SELECT person_id, people_version, seed, group_name, number, eye_hand, spatial, planning, conduct, strategy
FROM simulated_truth ORDER BY group_name, seed, number, people_version
