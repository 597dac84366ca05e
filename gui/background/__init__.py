"""Work beside the main thread: tasks, commands in processes of their own. On nothing else of `gui`."""
