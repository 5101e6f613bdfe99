-- A curriculum without items.
INSERT INTO curriculum (curriculum_id, title, state, made_by, made_us)
VALUES (:curriculum_id, :title, 'draft', :made_by, :made_us)
