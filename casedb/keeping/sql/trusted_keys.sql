SELECT public_key, label, added_us FROM trusted_key ORDER BY label
