-- Sessions that opened nothing any more.
DELETE FROM login_session
WHERE ends_us <= :now_us OR begun_us > :now_us
