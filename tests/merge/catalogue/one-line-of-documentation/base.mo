model A
  annotation (Documentation(info = "<p>a</p>
"));
end A;
