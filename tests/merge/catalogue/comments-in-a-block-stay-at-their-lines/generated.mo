model A
equation
  when a then
    b = 1;
    c = 1;
    d = 2;
  end when;
end A;
