model A
  input Real m;
external "C" y = f(u) annotation (Library = "m");
end A;
