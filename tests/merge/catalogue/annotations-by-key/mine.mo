model A
  annotation (Dialog(group = "a", tab = "m"), __Dymola_x = 1, __Dymola_m = 1);
end A;
