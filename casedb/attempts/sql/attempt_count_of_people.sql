-- How many attempts there are of the people of the JSON list :people, and with :nobodys of no person.
SELECT count(*) AS attempts FROM attempt
WHERE person_id IN (SELECT value FROM json_each(:people)) OR :nobodys AND person_id IS NULL
