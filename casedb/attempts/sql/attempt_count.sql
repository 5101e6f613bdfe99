-- How many attempts there are.
SELECT count(*) AS attempts FROM attempt
