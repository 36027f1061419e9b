model A
equation
  when a then
    b = 1;
    c = 1;
    d = 1;
  end when;
end A;
