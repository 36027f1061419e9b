model A
equation
  if a then
    x = 1;
  else
    x = 3;
  end if;
end A;
