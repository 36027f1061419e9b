
  function place "Position at a time; ways has a row for each instant: the coefficients of the time since that instant"
    input Real t;
    input Real ways[:, 6];
    output Real y;
  protected
    Integer k = integer(floor(t)) + 1;
    Real s = t + 1 - k;
    Real c[6] = ways[k, :];
  algorithm
    y := c[1] + s*(c[2] + s*(c[3] + s*(c[4] + s*(c[5] + s*c[6]))));
    annotation (derivative(noDerivative = ways) = speed);
  end place;

  function speed "First derivative of place"
    input Real t;
    input Real ways[:, 6];
    input Real t1;
    output Real y;
  protected
    Integer k = integer(floor(t)) + 1;
    Real s = t + 1 - k;
    Real c[6] = ways[k, :];
  algorithm
    y := (c[2] + s*(2*c[3] + s*(3*c[4] + s*(4*c[5] + s*5*c[6]))))*t1;
    annotation (derivative(noDerivative = ways, order = 2) = gain);
  end speed;

  function gain "Second derivative of place"
    input Real t;
    input Real ways[:, 6];
    input Real t1;
    input Real t2;
    output Real y;
  protected
    Integer k = integer(floor(t)) + 1;
    Real s = t + 1 - k;
    Real c[6] = ways[k, :];
  algorithm
    y := (2*c[3] + s*(6*c[4] + s*(12*c[5] + s*20*c[6])))*t1^2 + (c[2] + s*(2*c[3] + s*(3*c[4] + s*(4*c[5] + s*5*c[6]))))*t2;
  end gain;

  model RotationalDrive "Moves a flange"
    parameter Real ways[:, 6];
    Modelica.Mechanics.Rotational.Interfaces.Flange_b flange;
  equation
    flange.phi = place(time, ways);
  end RotationalDrive;

  model TranslationalDrive "Moves a flange"
    parameter Real ways[:, 6];
    Modelica.Mechanics.Translational.Interfaces.Flange_b flange;
  equation
    flange.s = place(time, ways);
  end TranslationalDrive;

  model RotationalPush "Pushes a flange"
    parameter Real effort = 0;
    Modelica.Mechanics.Rotational.Interfaces.Flange_b flange;
  equation
    flange.tau = -effort;
  end RotationalPush;

  model TranslationalPush "Pushes a flange"
    parameter Real effort = 0;
    Modelica.Mechanics.Translational.Interfaces.Flange_b flange;
  equation
    flange.f = -effort;
  end TranslationalPush;

  model BallDrive "Turns frame_b about an axis of a joint's frame"
    extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;
    parameter Real ways[:, 6];
    parameter Real axis[3] annotation (Evaluate = true); // OpenModelica differentiates no product of vectors of parameters
    parameter Real rpy[3] "Angles of the joint's frame in frame_a";
    Modelica.Units.SI.Angle phi;
    Modelica.Units.SI.AngularVelocity w;
    Modelica.Mechanics.MultiBody.Frames.Orientation R;
    Real t[3] = -frame_b.t;
  equation
    Connections.branch(frame_a.R, frame_b.R);
    phi = place(time, ways);
    w = der(phi);
    R = Modelica.Mechanics.MultiBody.Frames.absoluteRotation(
      Modelica.Mechanics.MultiBody.Frames.axesRotations({3, 2, 1}, {rpy[3], rpy[2], rpy[1]}, zeros(3)),
      Modelica.Mechanics.MultiBody.Frames.planarRotation(axis, phi, w));
    frame_b.R = Modelica.Mechanics.MultiBody.Frames.absoluteRotation(frame_a.R, R);
    frame_a.f = zeros(3);
    frame_b.f = zeros(3);
    frame_a.t = -Modelica.Mechanics.MultiBody.Frames.resolve1(R, frame_b.t);
  end BallDrive;

  model MovingBase "Moves and turns a frame"
    parameter Real x[:, 6];
    parameter Real y[:, 6];
    parameter Real z[:, 6];
    parameter Real turn[:, 6];
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

