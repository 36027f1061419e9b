within UrdfSync.UsersGuide;

class Literature "Where methods and formats come from"
  extends Modelica.Icons.References;

  annotation (
    preferredView="info",
    Documentation(info="<html>
<dl>
<dt>A. Pign&egrave;de and C. Oldemeyer:</dt>
<dd><strong>Automatic Modelica Package and Model Generation from Templates and Data Files with Python, Exemplified with URDF</strong>.
Modelica Conference, 2025. The method of this library: the package approach, the record approach and the friction law.</dd>
<dt>M. Otter, H. Elmqvist and S. E. Mattsson:</dt>
<dd><strong>The New Modelica MultiBody Library</strong>. Modelica Conference, Link&ouml;ping, 2003, pages 311 to 330. The parts that links
and joints are made of.</dd>
<dt>R. Featherstone:</dt>
<dd><strong>Rigid Body Dynamics Algorithms</strong>. Springer, 2008. Tensors and coordinate transformations; the composite-rigid-body and the
articulated-body algorithm.</dd>
<dt>J. Y. S. Luh, M. W. Walker and R. P. C. Paul:</dt>
<dd><strong>On-Line Computational Scheme for Mechanical Manipulators</strong>. Journal of Dynamic Systems, Measurement, and Control 102, 1980.
The recursive Newton-Euler algorithm.</dd>
<dt>J. J. Craig:</dt>
<dd><strong>Introduction to Robotics: Mechanics and Control</strong>. Angles about fixed axes: chapter 2.</dd>
<dt>K. H. Hunt and F. R. E. Crossley:</dt>
<dd><strong>Coefficient of Restitution Interpreted as Damping in Vibroimpact</strong>. Journal of Applied Mechanics 42, 1975. The normal
force of the ground.</dd>
<dt>E. Pennestr&igrave;, V. Rossi, P. Salvini and P. P. Valentini:</dt>
<dd><strong>Review and Comparison of Dry Friction Force Models</strong>. Nonlinear Dynamics 83, 2016. Smooth friction laws.</dd>
<dt>URDF:</dt>
<dd><a href=\"https://wiki.ros.org/urdf/XML\">XML specification of URDF</a>. Where it leaves something open, the behaviour of
<a href=\"https://github.com/ros/urdfdom\">urdfdom</a>, the parser of ROS, counts.</dd>
</dl>
</html>"));
end Literature;
