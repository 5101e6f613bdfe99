-- Attempts of consultants on a case, newest first. Found by who was ever a consultant, of whom there are few: a case
-- has thousands of attempts.
SELECT attempt_summary.* FROM (SELECT DISTINCT person_id FROM person_level WHERE level = 'consultant') AS consultant
CROSS JOIN attempt_summary ON attempt_summary.person_id = consultant.person_id
JOIN expert_attempt ON expert_attempt.attempt_id = attempt_summary.attempt_id
WHERE attempt_summary.case_id = :case_id AND expert_attempt.kind = 'consultants'
ORDER BY started_us DESC, attempt_summary.attempt_id DESC
