model A
equation
  if a then
    x = 1;
  else
    x = 2;
  end if;
end A;
