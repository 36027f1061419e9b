within ;

record PostParameters "Numbers of robot Post as a whole"
  extends UrdfSync.Records.Robot(
    name = "post",
    connectionMatrix = fill(0, 0, 2),
    moveableJoints = fill(0, 0, 2),
    firstJoints = {1},
    linkBodies = {1},
    linkMasses = {
      mast.inertial.mass},
    linkCenters = {
      mast.inertial.origin.xyz},
    inertialAngles = {
      mast.inertial.origin.rpy},
    linkInertias = {
      {mast.inertial.inertia.ixx, mast.inertial.inertia.iyy, mast.inertial.inertia.izz,
       mast.inertial.inertia.ixy, mast.inertial.inertia.ixz, mast.inertial.inertia.iyz}});

  UrdfSync.Records.Link mast(
    name = "mast",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1,
      inertia(
        ixx = 1,
        iyy = 1,
        izz = 1,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 1: \"mast\"";

  annotation (
    uses(
      Modelica(version="4.0.0"),
      UrdfSync(version="1.0.0")),
    Documentation(info="<html>
<p>
All numbers of robot Post in one record, with the tables by which <code>UrdfSync.Robots.GenericRobot</code> reads how links and joints hang together. The tables refer to the numbers below them. Where the package has models of the links and joints, these read the records of their elements, and the numbers here are a copy: an edit here changes no such model.
</p>
</html>"));
end PostParameters;
