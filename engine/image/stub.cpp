// Temporary: keeps the target buildable until its first source file arrives; delete me.
