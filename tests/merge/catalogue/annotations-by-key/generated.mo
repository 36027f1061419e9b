model A
  annotation (Dialog(group = "g"), __Dymola_x = 2, Evaluate = true, __OpenModelica_g = 1);
end A;
