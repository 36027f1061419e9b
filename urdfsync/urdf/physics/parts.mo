
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

