
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

  model RotationalDrive "Moves a flange"
    parameter Real courses[:, 3];
    Modelica.Mechanics.Rotational.Interfaces.Flange_b flange;
  equation
    flange.phi = place(time, courses);
  end RotationalDrive;

  model TranslationalDrive "Moves a flange"
    parameter Real courses[:, 3];
    Modelica.Mechanics.Translational.Interfaces.Flange_b flange;
  equation
    flange.s = place(time, courses);
  end TranslationalDrive;

  model RotationalPush "Pushes a flange"
    parameter Real effort = 0;
    Modelica.Mechanics.Rotational.Interfaces.Flange_b flange;
    Real v = der(flange.phi);
    Real a = der(v);
  equation
    flange.tau = -effort;
  end RotationalPush;

  model TranslationalPush "Pushes a flange"
    parameter Real effort = 0;
    Modelica.Mechanics.Translational.Interfaces.Flange_b flange;
    Real v = der(flange.s);
    Real a = der(v);
  equation
    flange.f = -effort;
  end TranslationalPush;

  model MovingBase "Moves and turns a frame"
    parameter Real x[:, 3];
    parameter Real y[:, 3];
    parameter Real z[:, 3];
    parameter Real turn[:, 3];
    parameter Real axis[3];
    Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b;
    Modelica.Units.SI.Angle phi;
    Modelica.Units.SI.AngularVelocity w;
  equation
    Connections.root(frame_b.R);
    frame_b.r_0 = {place(time, x), place(time, y), place(time, z)};
    phi = place(time, turn);
    w = der(phi);
    frame_b.R = Modelica.Mechanics.MultiBody.Frames.planarRotation(axis, phi, w);
  end MovingBase;

