model A
  function f
    input Real x;
    input Real y "second";
    input Real m;
    output Real z;
  algorithm
    z := x + y;
  end f;
  Real a = 1;
end A;
