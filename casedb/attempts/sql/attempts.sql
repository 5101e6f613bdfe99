-- Attempts, newest first: :count of them from the one at :first.
SELECT * FROM attempt_summary
ORDER BY started_us DESC, attempt_id DESC
LIMIT :count OFFSET :first
