"""Which effects are tried beside the law, alone and in pairs, and what each is worth."""
