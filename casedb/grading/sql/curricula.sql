-- Every curriculum, oldest first.
SELECT curriculum_id, title, state, made_by, made_us, published_us FROM curriculum
ORDER BY made_us, curriculum_id
