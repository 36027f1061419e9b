model A
equation
  for i in 1:2 loop
    x[i] = 5;
  end for;
  when a then
    b = 7;
  end when;
end A;
