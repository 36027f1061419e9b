within UrdfSync.Functions;

function limitedEffort "Torque or force that a drive gives when it is asked for one"
  extends Modelica.Icons.Function;

  input Real effort
    "Torque or force that is asked for";

  input Real speed
    "Speed of the joint";

  input Real effort_max
    "Limit of the effort";

  input Real speed_max
    "Limit of the speed";

  output Real given
    "Torque or force that is given";

protected
  constant Real fading = 0.05
    "Share of the speed limit over which the effort fades out";

algorithm
  given := max(-effort_max, min(effort_max, effort));
  if given*speed > 0 then
    given := given*max(0, min(1, (speed_max - abs(speed))/max(fading*speed_max, Modelica.Constants.small)));
  end if;

  annotation (Documentation(info="<html>
<p>
The effort is cut at its limit. What speeds the joint up fades out linearly over the last twentieth below the speed limit, where it is zero; what slows it down does not.
</p>
</html>"));
end limitedEffort;
