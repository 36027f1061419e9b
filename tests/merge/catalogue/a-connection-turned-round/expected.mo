model A
equation
  connect(b, a) annotation (Dialog); // mine
end A;
