model A
equation
  connect(a, b) annotation (Dialog);
end A;
