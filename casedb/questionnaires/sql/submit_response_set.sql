-- A draft is done; what the browser kept opens nothing any more.
UPDATE response_set SET submitted_us = :now_us, draft_key = NULL WHERE response_id = :response_id
