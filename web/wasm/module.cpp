// Modules consist of libraries alone; this is the file that a program must have.
