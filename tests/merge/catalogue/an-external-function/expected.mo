model A
  input Real m;
external "C" y = g(u) annotation (Library = "m");
end A;
