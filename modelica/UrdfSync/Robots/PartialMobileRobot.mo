within UrdfSync.Robots;

partial model PartialMobileRobot "Robot that moves freely and touches the ground"
  extends UrdfSync.Icons.MobileRobot;
  extends UrdfSync.Robots.PartialRobot;

  annotation (Documentation(info="<html>
<p>
Its collision shapes touch the ground; a bench gives it the ground and six degrees of freedom.
</p>
</html>"));
end PartialMobileRobot;
