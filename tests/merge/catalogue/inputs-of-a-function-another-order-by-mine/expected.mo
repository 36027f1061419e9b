model A
  function f
    input Real y "second";
    input Real x;
    output Real z;
  algorithm
    z := x + y;
  end f;
  Real a = 2;
end A;
