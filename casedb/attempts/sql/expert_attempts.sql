-- Attempts of the simulated expert on a case, newest first: at most :most.
SELECT attempt_summary.* FROM attempt_summary
JOIN expert_attempt ON expert_attempt.attempt_id = attempt_summary.attempt_id
WHERE expert_attempt.case_id = :case_id AND expert_attempt.kind = 'simulated'
ORDER BY started_us DESC, attempt_summary.attempt_id DESC
LIMIT :most
