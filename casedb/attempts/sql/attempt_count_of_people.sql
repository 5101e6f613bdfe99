-- How many attempts there are of the people of the JSON list :people, and with :nobodys of no person.
SELECT (SELECT count(*) FROM attempt WHERE person_id IN (SELECT value FROM json_each(:people)))
  + (SELECT count(*) FROM attempt WHERE :nobodys AND person_id IS NULL) AS attempts
