model A
  annotation (Dialog(group = "g", tab = "m"), __Dymola_x = 2, __Dymola_m = 1, __OpenModelica_g = 1);
end A;
