within UrdfSync.UsersGuide;

class RecordApproach "The whole robot as one record"
  extends Modelica.Icons.Information;

  annotation (
    preferredView="info",
    Documentation(info="<html>
<p>
<code>&lt;Robot&gt;Parameters.mo</code> holds all numbers of the robot in one record: name, tables, and one component per link and per
joint. It extends <a href=\"modelica://UrdfSync.Records.Robot\">Records.Robot</a>.
</p>
<dl>
<dt><code>connectionMatrix</code></dt>
<dd>One row per joint: number of the parent link, number of the child link.</dd>
<dt><code>moveableJoints</code></dt>
<dd>One row per joint that is not fixed: number of the joint, 1.</dd>
</dl>
<p>
Links and joints are numbered from 1, depth-first from the root, siblings in natural order of their names. So link 1 is the root, and
joint <code>k</code> leads to link <code>k + 1</code>.
</p>
<p>
Pign&egrave;de and Oldemeyer call this the model structure defining record: one generic robot model can read the structure of any robot
from it. This version of the library has the record but no generic robot model. The robot models that <code>urdfsync</code> generates take
their numbers from the records of their links and joints, not from this one.
</p>
</html>"));
end RecordApproach;
