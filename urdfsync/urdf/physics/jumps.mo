
  function place "A parabola around each second"
    input Real t;
    input Real courses[:, 3];
    output Real y;
  protected
    Integer k = integer(floor(t + 0.5));
  algorithm
    y := courses[k + 1, 1] + courses[k + 1, 2]*(t - k) + courses[k + 1, 3]*(t - k)^2/2;
    annotation (derivative(noDerivative = courses) = speed);
  end place;

  function speed "Its first derivative"
    input Real t;
    input Real courses[:, 3];
    input Real t1;
    output Real y;
  protected
    Integer k = integer(floor(t + 0.5));
  algorithm
    y := (courses[k + 1, 2] + courses[k + 1, 3]*(t - k))*t1;
    annotation (derivative(noDerivative = courses, order = 2) = gain);
  end speed;

  function gain "Its second derivative"
    input Real t;
    input Real courses[:, 3];
    input Real t1;
    input Real t2;
    output Real y;
  protected
    Integer k = integer(floor(t + 0.5));
  algorithm
    y := courses[k + 1, 3]*t1^2 + (courses[k + 1, 2] + courses[k + 1, 3]*(t - k))*t2;
  end gain;
