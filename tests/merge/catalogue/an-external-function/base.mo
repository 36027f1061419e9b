model A
external "C" y = f(u) annotation (Library = "m");
end A;
