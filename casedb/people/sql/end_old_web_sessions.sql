-- Sessions of pages that opened nothing any more.
DELETE FROM web_session
WHERE ends_us <= :now_us OR begun_us > :now_us
