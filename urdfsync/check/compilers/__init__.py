"""rumoca and OpenModelica, each in a process of its own."""
