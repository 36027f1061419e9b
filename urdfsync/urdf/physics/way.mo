
  function coefficients "Those of the parabola at the last instant, and what brings it to the next one"
    input Real t;
    input Real courses[:, 3];
    output Real c[6];
  protected
    Integer k = min(integer(floor(t)), size(courses, 1) - 2);
    Real d = courses[k + 2, 1] - courses[k + 1, 1] - courses[k + 1, 2] - courses[k + 1, 3]/2;
    Real v = courses[k + 2, 2] - courses[k + 1, 2] - courses[k + 1, 3];
    Real a = courses[k + 2, 3] - courses[k + 1, 3];
  algorithm
    c := {courses[k + 1, 1], courses[k + 1, 2], courses[k + 1, 3]/2, 10*d - 4*v + a/2, 7*v - 15*d - a, 6*d - 3*v + a/2};
  end coefficients;

  function place "From one instant to the next, with the speed and the acceleration of both"
    input Real t;
    input Real courses[:, 3];
    output Real y;
  protected
    Integer k = min(integer(floor(t)), size(courses, 1) - 2);
    Real s = t - k;
    Real c[6] = coefficients(t, courses);
  algorithm
    y := c[1] + s*(c[2] + s*(c[3] + s*(c[4] + s*(c[5] + s*c[6]))));
    annotation (derivative(noDerivative = courses) = speed);
  end place;

  function speed "Its first derivative"
    input Real t;
    input Real courses[:, 3];
    input Real t1;
    output Real y;
  protected
    Integer k = min(integer(floor(t)), size(courses, 1) - 2);
    Real s = t - k;
    Real c[6] = coefficients(t, courses);
  algorithm
    y := (c[2] + s*(2*c[3] + s*(3*c[4] + s*(4*c[5] + s*5*c[6]))))*t1;
    annotation (derivative(noDerivative = courses, order = 2) = gain);
  end speed;

  function gain "Its second derivative"
    input Real t;
    input Real courses[:, 3];
    input Real t1;
    input Real t2;
    output Real y;
  protected
    Integer k = min(integer(floor(t)), size(courses, 1) - 2);
    Real s = t - k;
    Real c[6] = coefficients(t, courses);
  algorithm
    y := (2*c[3] + s*(6*c[4] + s*(12*c[5] + s*20*c[6])))*t1^2 + (c[2] + s*(2*c[3] + s*(3*c[4] + s*(4*c[5] + s*5*c[6]))))*t2;
  end gain;
