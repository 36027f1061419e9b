model A
equation
  if a then
    x = 1; // m
    y = 1;
  else
    x = 3;
  end if;
end A;
