model A
external "C" y = g(u) annotation (Library = "m");
end A;
