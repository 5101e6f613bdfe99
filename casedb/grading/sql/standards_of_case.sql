-- Newest first: of one task the first is in force.
SELECT standard_id, lesion_id, picture_modality, approach, instrument_kind, set_id, people, attempts, newest_us,
       set_us
FROM standard WHERE case_id = :case_id
ORDER BY set_us DESC, standard_id DESC
