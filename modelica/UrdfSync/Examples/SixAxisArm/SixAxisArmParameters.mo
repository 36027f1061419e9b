within UrdfSync.Examples.SixAxisArm;

record SixAxisArmParameters "Numbers of robot SixAxisArm as a whole"
  extends UrdfSync.Records.Robot(
    name = "six_axis_arm",
    connectionMatrix = [1, 2; 2, 3; 3, 4; 4, 5; 5, 6; 6, 7; 7, 8; 8, 9; 9, 10; 9, 11; 9, 12; 9, 13],
    moveableJoints = [1, 1; 2, 1; 3, 1; 4, 1; 5, 1; 6, 1; 9, 1; 11, 1; 12, 1],
    movingJoints = 9,
    turningJoints = 7,
    slidingJoints = 2,
    rotationalAxes = 6,
    translationalAxes = 1,
    jointTree = {{1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, 1}, {6, 1}, {7, 2}, {7, 2}, {7, 1}},
    firstJoints = {1, 2, 3, 4, 5, 6, 7, 10, 10, 10},
    nextJoints = {10, 10, 10, 10, 10, 10, 8, 9, 10},
    linkBodies = {
      1, 2, 3, 4, 5, 6, 7, 7, 7, 8,
      7, 9, 10},
    turning = {1, 2, 3, 4, 5, 6, 9},
    sliding = {7, 8},
    rotationalJoints = {1, 2, 3, 4, 5, 6},
    translationalJoints = {8},
    followers = {{7, 8}, {9, 8}},
    jointAxes = {
      turret.axis,
      shoulder.axis,
      elbow.axis,
      forearm_roll.axis,
      wrist_pitch.axis,
      flange_roll.axis,
      finger_coupling.axis,
      gripper_stroke.axis,
      pinion_coupling.axis},
    jointPositions = {
      turret.origin.xyz,
      shoulder.origin.xyz,
      elbow.origin.xyz,
      forearm_roll.origin.xyz,
      wrist_pitch.origin.xyz,
      flange_roll.origin.xyz,
      flange_to_tool.origin.xyz,
      gripper_mount.origin.xyz,
      finger_coupling.origin.xyz,
      grasp_frame.origin.xyz,
      gripper_stroke.origin.xyz,
      pinion_coupling.origin.xyz},
    jointAngles = {
      turret.origin.rpy,
      shoulder.origin.rpy,
      elbow.origin.rpy,
      forearm_roll.origin.rpy,
      wrist_pitch.origin.rpy,
      flange_roll.origin.rpy,
      flange_to_tool.origin.rpy,
      gripper_mount.origin.rpy,
      finger_coupling.origin.rpy,
      grasp_frame.origin.rpy,
      gripper_stroke.origin.rpy,
      pinion_coupling.origin.rpy},
    followerMultipliers = {
      finger_coupling.mimic.multiplier,
      pinion_coupling.mimic.multiplier},
    followerAngles = {
      0,
      pinion_coupling.mimic.offset},
    followerLengths = {
      finger_coupling.mimic.offset,
      0},
    linkMasses = {
      base_link.inertial.mass,
      carousel.inertial.mass,
      upper_arm.inertial.mass,
      elbow_housing.inertial.mass,
      forearm.inertial.mass,
      wrist.inertial.mass,
      mounting_flange.inertial.mass,
      tool0.inertial.mass,
      gripper_body.inertial.mass,
      finger_right.inertial.mass,
      grasp_point.inertial.mass,
      finger_left.inertial.mass,
      drive_pinion.inertial.mass},
    linkCenters = {
      base_link.inertial.origin.xyz,
      carousel.inertial.origin.xyz,
      upper_arm.inertial.origin.xyz,
      elbow_housing.inertial.origin.xyz,
      forearm.inertial.origin.xyz,
      wrist.inertial.origin.xyz,
      mounting_flange.inertial.origin.xyz,
      tool0.inertial.origin.xyz,
      gripper_body.inertial.origin.xyz,
      finger_right.inertial.origin.xyz,
      grasp_point.inertial.origin.xyz,
      finger_left.inertial.origin.xyz,
      drive_pinion.inertial.origin.xyz},
    inertialAngles = {
      base_link.inertial.origin.rpy,
      carousel.inertial.origin.rpy,
      upper_arm.inertial.origin.rpy,
      elbow_housing.inertial.origin.rpy,
      forearm.inertial.origin.rpy,
      wrist.inertial.origin.rpy,
      mounting_flange.inertial.origin.rpy,
      tool0.inertial.origin.rpy,
      gripper_body.inertial.origin.rpy,
      finger_right.inertial.origin.rpy,
      grasp_point.inertial.origin.rpy,
      finger_left.inertial.origin.rpy,
      drive_pinion.inertial.origin.rpy},
    linkInertias = {
      {base_link.inertial.inertia.ixx, base_link.inertial.inertia.iyy, base_link.inertial.inertia.izz,
       base_link.inertial.inertia.ixy, base_link.inertial.inertia.ixz, base_link.inertial.inertia.iyz},
      {carousel.inertial.inertia.ixx, carousel.inertial.inertia.iyy, carousel.inertial.inertia.izz,
       carousel.inertial.inertia.ixy, carousel.inertial.inertia.ixz, carousel.inertial.inertia.iyz},
      {upper_arm.inertial.inertia.ixx, upper_arm.inertial.inertia.iyy, upper_arm.inertial.inertia.izz,
       upper_arm.inertial.inertia.ixy, upper_arm.inertial.inertia.ixz, upper_arm.inertial.inertia.iyz},
      {elbow_housing.inertial.inertia.ixx, elbow_housing.inertial.inertia.iyy, elbow_housing.inertial.inertia.izz,
       elbow_housing.inertial.inertia.ixy, elbow_housing.inertial.inertia.ixz, elbow_housing.inertial.inertia.iyz},
      {forearm.inertial.inertia.ixx, forearm.inertial.inertia.iyy, forearm.inertial.inertia.izz,
       forearm.inertial.inertia.ixy, forearm.inertial.inertia.ixz, forearm.inertial.inertia.iyz},
      {wrist.inertial.inertia.ixx, wrist.inertial.inertia.iyy, wrist.inertial.inertia.izz,
       wrist.inertial.inertia.ixy, wrist.inertial.inertia.ixz, wrist.inertial.inertia.iyz},
      {mounting_flange.inertial.inertia.ixx, mounting_flange.inertial.inertia.iyy, mounting_flange.inertial.inertia.izz,
       mounting_flange.inertial.inertia.ixy, mounting_flange.inertial.inertia.ixz, mounting_flange.inertial.inertia.iyz},
      {tool0.inertial.inertia.ixx, tool0.inertial.inertia.iyy, tool0.inertial.inertia.izz,
       tool0.inertial.inertia.ixy, tool0.inertial.inertia.ixz, tool0.inertial.inertia.iyz},
      {gripper_body.inertial.inertia.ixx, gripper_body.inertial.inertia.iyy, gripper_body.inertial.inertia.izz,
       gripper_body.inertial.inertia.ixy, gripper_body.inertial.inertia.ixz, gripper_body.inertial.inertia.iyz},
      {finger_right.inertial.inertia.ixx, finger_right.inertial.inertia.iyy, finger_right.inertial.inertia.izz,
       finger_right.inertial.inertia.ixy, finger_right.inertial.inertia.ixz, finger_right.inertial.inertia.iyz},
      {grasp_point.inertial.inertia.ixx, grasp_point.inertial.inertia.iyy, grasp_point.inertial.inertia.izz,
       grasp_point.inertial.inertia.ixy, grasp_point.inertial.inertia.ixz, grasp_point.inertial.inertia.iyz},
      {finger_left.inertial.inertia.ixx, finger_left.inertial.inertia.iyy, finger_left.inertial.inertia.izz,
       finger_left.inertial.inertia.ixy, finger_left.inertial.inertia.ixz, finger_left.inertial.inertia.iyz},
      {drive_pinion.inertial.inertia.ixx, drive_pinion.inertial.inertia.iyy, drive_pinion.inertial.inertia.izz,
       drive_pinion.inertial.inertia.ixy, drive_pinion.inertial.inertia.ixz, drive_pinion.inertial.inertia.iyz}},
    jointNames(
      name = {
        turret.name,
        shoulder.name,
        elbow.name,
        forearm_roll.name,
        wrist_pitch.name,
        flange_roll.name,
        finger_coupling.name,
        gripper_stroke.name,
        pinion_coupling.name}),
    turningLimits(
      lower = {
        turret.limits.lower,
        shoulder.limits.lower,
        elbow.limits.lower,
        forearm_roll.limits.lower,
        wrist_pitch.limits.lower,
        flange_roll.limits.lower,
        pinion_coupling.limits.lower},
      upper = {
        turret.limits.upper,
        shoulder.limits.upper,
        elbow.limits.upper,
        forearm_roll.limits.upper,
        wrist_pitch.limits.upper,
        flange_roll.limits.upper,
        pinion_coupling.limits.upper},
      velocity = {
        turret.limits.velocity,
        shoulder.limits.velocity,
        elbow.limits.velocity,
        forearm_roll.limits.velocity,
        wrist_pitch.limits.velocity,
        flange_roll.limits.velocity,
        pinion_coupling.limits.velocity},
      effort = {
        turret.limits.effort,
        shoulder.limits.effort,
        elbow.limits.effort,
        forearm_roll.limits.effort,
        wrist_pitch.limits.effort,
        flange_roll.limits.effort,
        pinion_coupling.limits.effort}),
    turningLosses(
      damping = {
        turret.dynamics.damping,
        shoulder.dynamics.damping,
        elbow.dynamics.damping,
        forearm_roll.dynamics.damping,
        wrist_pitch.dynamics.damping,
        flange_roll.dynamics.damping,
        pinion_coupling.dynamics.damping},
      friction = {
        turret.dynamics.friction,
        shoulder.dynamics.friction,
        elbow.dynamics.friction,
        forearm_roll.dynamics.friction,
        wrist_pitch.dynamics.friction,
        flange_roll.dynamics.friction,
        pinion_coupling.dynamics.friction},
      steepness = {
        turret.dynamics.steepness,
        shoulder.dynamics.steepness,
        elbow.dynamics.steepness,
        forearm_roll.dynamics.steepness,
        wrist_pitch.dynamics.steepness,
        flange_roll.dynamics.steepness,
        pinion_coupling.dynamics.steepness}),
    slidingLimits(
      lower = {
        finger_coupling.limits.lower,
        gripper_stroke.limits.lower},
      upper = {
        finger_coupling.limits.upper,
        gripper_stroke.limits.upper},
      velocity = {
        finger_coupling.limits.velocity,
        gripper_stroke.limits.velocity},
      effort = {
        finger_coupling.limits.effort,
        gripper_stroke.limits.effort}),
    slidingLosses(
      damping = {
        finger_coupling.dynamics.damping,
        gripper_stroke.dynamics.damping},
      friction = {
        finger_coupling.dynamics.friction,
        gripper_stroke.dynamics.friction},
      steepness = {
        finger_coupling.dynamics.steepness,
        gripper_stroke.dynamics.steepness}),
    drawnShapes = 44,
    visuals(
      links = {
        1, 1, 1, 1, 1, 1, 1, 2, 2, 2,
        3, 3, 3, 3, 3, 4, 4, 4, 4, 4,
        5, 5, 5, 5, 5, 5, 6, 6, 7, 7,
        9, 9, 9, 9, 10, 10, 10, 10, 12, 12,
        12, 12, 13, 13},
      kinds = {
        "box",
        base_linkVisual2.uri,
        "box",
        "cylinder",
        "cylinder",
        "cylinder",
        "cylinder",
        "cylinder",
        carouselVisual2.uri,
        "cylinder",
        upper_armVisual1.uri,
        upper_armVisual2.uri,
        "box",
        "cylinder",
        "cylinder",
        elbow_housingVisual1.uri,
        "cylinder",
        "cylinder",
        "cylinder",
        "box",
        forearmVisual1.uri,
        "box",
        "box",
        "box",
        "cylinder",
        "cylinder",
        "cylinder",
        "cylinder",
        "cylinder",
        "box",
        "cylinder",
        "box",
        "box",
        "box",
        "box",
        "box",
        finger_rightVisual3.uri,
        "box",
        "box",
        "box",
        finger_leftVisual3.uri,
        "box",
        drive_pinionVisual1.uri,
        "cylinder"},
      lengthAxes = {
        1, 1, 1, 3, 3, 3, 3, 3, 1, 3,
        1, 1, 1, 3, 3, 1, 3, 3, 3, 1,
        1, 1, 1, 1, 3, 3, 3, 3, 3, 1,
        3, 1, 1, 1, 1, 1, 1, 1, 1, 1,
        1, 1, 1, 3},
      positions = {
        base_linkVisual1.origin.xyz,
        base_linkVisual2.origin.xyz,
        base_linkVisual3.origin.xyz,
        base_linkVisual4.origin.xyz,
        base_linkVisual5.origin.xyz,
        base_linkVisual6.origin.xyz,
        base_linkVisual7.origin.xyz,
        carouselVisual1.origin.xyz,
        carouselVisual2.origin.xyz,
        carouselVisual3.origin.xyz,
        upper_armVisual1.origin.xyz,
        upper_armVisual2.origin.xyz,
        upper_armVisual3.origin.xyz,
        upper_armVisual4.origin.xyz,
        upper_armVisual5.origin.xyz,
        elbow_housingVisual1.origin.xyz,
        elbow_housingVisual2.origin.xyz,
        elbow_housingVisual3.origin.xyz,
        elbow_housingVisual4.origin.xyz,
        elbow_housingVisual5.origin.xyz,
        forearmVisual1.origin.xyz,
        forearmVisual2.origin.xyz,
        forearmVisual3.origin.xyz,
        forearmVisual4.origin.xyz,
        forearmVisual5.origin.xyz,
        forearmVisual6.origin.xyz,
        wristVisual1.origin.xyz,
        wristVisual2.origin.xyz,
        mounting_flangeVisual1.origin.xyz,
        mounting_flangeVisual2.origin.xyz,
        gripper_bodyVisual1.origin.xyz,
        gripper_bodyVisual2.origin.xyz,
        gripper_bodyVisual3.origin.xyz,
        gripper_bodyVisual4.origin.xyz,
        finger_rightVisual1.origin.xyz,
        finger_rightVisual2.origin.xyz,
        finger_rightVisual3.origin.xyz,
        finger_rightVisual4.origin.xyz,
        finger_leftVisual1.origin.xyz,
        finger_leftVisual2.origin.xyz,
        finger_leftVisual3.origin.xyz,
        finger_leftVisual4.origin.xyz,
        drive_pinionVisual1.origin.xyz,
        drive_pinionVisual2.origin.xyz},
      angles = {
        base_linkVisual1.origin.rpy,
        base_linkVisual2.origin.rpy,
        base_linkVisual3.origin.rpy,
        base_linkVisual4.origin.rpy,
        base_linkVisual5.origin.rpy,
        base_linkVisual6.origin.rpy,
        base_linkVisual7.origin.rpy,
        carouselVisual1.origin.rpy,
        carouselVisual2.origin.rpy,
        carouselVisual3.origin.rpy,
        upper_armVisual1.origin.rpy,
        upper_armVisual2.origin.rpy,
        upper_armVisual3.origin.rpy,
        upper_armVisual4.origin.rpy,
        upper_armVisual5.origin.rpy,
        elbow_housingVisual1.origin.rpy,
        elbow_housingVisual2.origin.rpy,
        elbow_housingVisual3.origin.rpy,
        elbow_housingVisual4.origin.rpy,
        elbow_housingVisual5.origin.rpy,
        forearmVisual1.origin.rpy,
        forearmVisual2.origin.rpy,
        forearmVisual3.origin.rpy,
        forearmVisual4.origin.rpy,
        forearmVisual5.origin.rpy,
        forearmVisual6.origin.rpy,
        wristVisual1.origin.rpy,
        wristVisual2.origin.rpy,
        mounting_flangeVisual1.origin.rpy,
        mounting_flangeVisual2.origin.rpy,
        gripper_bodyVisual1.origin.rpy,
        gripper_bodyVisual2.origin.rpy,
        gripper_bodyVisual3.origin.rpy,
        gripper_bodyVisual4.origin.rpy,
        finger_rightVisual1.origin.rpy,
        finger_rightVisual2.origin.rpy,
        finger_rightVisual3.origin.rpy,
        finger_rightVisual4.origin.rpy,
        finger_leftVisual1.origin.rpy,
        finger_leftVisual2.origin.rpy,
        finger_leftVisual3.origin.rpy,
        finger_leftVisual4.origin.rpy,
        drive_pinionVisual1.origin.rpy,
        drive_pinionVisual2.origin.rpy},
      starts = {
        -0.5*base_linkVisual1.size[1],
        0,
        -0.5*base_linkVisual3.size[1],
        -0.5*base_linkVisual4.length,
        -0.5*base_linkVisual5.length,
        -0.5*base_linkVisual6.length,
        -0.5*base_linkVisual7.length,
        -0.5*carouselVisual1.length,
        0,
        -0.5*carouselVisual3.length,
        0,
        0,
        -0.5*upper_armVisual3.size[1],
        -0.5*upper_armVisual4.length,
        -0.5*upper_armVisual5.length,
        0,
        -0.5*elbow_housingVisual2.length,
        -0.5*elbow_housingVisual3.length,
        -0.5*elbow_housingVisual4.length,
        -0.5*elbow_housingVisual5.size[1],
        0,
        -0.5*forearmVisual2.size[1],
        -0.5*forearmVisual3.size[1],
        -0.5*forearmVisual4.size[1],
        -0.5*forearmVisual5.length,
        -0.5*forearmVisual6.length,
        -0.5*wristVisual1.length,
        -0.5*wristVisual2.length,
        -0.5*mounting_flangeVisual1.length,
        -0.5*mounting_flangeVisual2.size[1],
        -0.5*gripper_bodyVisual1.length,
        -0.5*gripper_bodyVisual2.size[1],
        -0.5*gripper_bodyVisual3.size[1],
        -0.5*gripper_bodyVisual4.size[1],
        -0.5*finger_rightVisual1.size[1],
        -0.5*finger_rightVisual2.size[1],
        0,
        -0.5*finger_rightVisual4.size[1],
        -0.5*finger_leftVisual1.size[1],
        -0.5*finger_leftVisual2.size[1],
        0,
        -0.5*finger_leftVisual4.size[1],
        0,
        -0.5*drive_pinionVisual2.length},
      sizes = {
        {base_linkVisual1.size[1], base_linkVisual1.size[2], base_linkVisual1.size[3]},
        {1, 1, 1},
        {base_linkVisual3.size[1], base_linkVisual3.size[2], base_linkVisual3.size[3]},
        {base_linkVisual4.length, 2*base_linkVisual4.radius, 2*base_linkVisual4.radius},
        {base_linkVisual5.length, 2*base_linkVisual5.radius, 2*base_linkVisual5.radius},
        {base_linkVisual6.length, 2*base_linkVisual6.radius, 2*base_linkVisual6.radius},
        {base_linkVisual7.length, 2*base_linkVisual7.radius, 2*base_linkVisual7.radius},
        {carouselVisual1.length, 2*carouselVisual1.radius, 2*carouselVisual1.radius},
        {1, 1, 1},
        {carouselVisual3.length, 2*carouselVisual3.radius, 2*carouselVisual3.radius},
        {1, 1, 1},
        {1, 1, 1},
        {upper_armVisual3.size[1], upper_armVisual3.size[2], upper_armVisual3.size[3]},
        {upper_armVisual4.length, 2*upper_armVisual4.radius, 2*upper_armVisual4.radius},
        {upper_armVisual5.length, 2*upper_armVisual5.radius, 2*upper_armVisual5.radius},
        {1, 1, 1},
        {elbow_housingVisual2.length, 2*elbow_housingVisual2.radius, 2*elbow_housingVisual2.radius},
        {elbow_housingVisual3.length, 2*elbow_housingVisual3.radius, 2*elbow_housingVisual3.radius},
        {elbow_housingVisual4.length, 2*elbow_housingVisual4.radius, 2*elbow_housingVisual4.radius},
        {elbow_housingVisual5.size[1], elbow_housingVisual5.size[2], elbow_housingVisual5.size[3]},
        {1, 1, 1},
        {forearmVisual2.size[1], forearmVisual2.size[2], forearmVisual2.size[3]},
        {forearmVisual3.size[1], forearmVisual3.size[2], forearmVisual3.size[3]},
        {forearmVisual4.size[1], forearmVisual4.size[2], forearmVisual4.size[3]},
        {forearmVisual5.length, 2*forearmVisual5.radius, 2*forearmVisual5.radius},
        {forearmVisual6.length, 2*forearmVisual6.radius, 2*forearmVisual6.radius},
        {wristVisual1.length, 2*wristVisual1.radius, 2*wristVisual1.radius},
        {wristVisual2.length, 2*wristVisual2.radius, 2*wristVisual2.radius},
        {mounting_flangeVisual1.length, 2*mounting_flangeVisual1.radius, 2*mounting_flangeVisual1.radius},
        {mounting_flangeVisual2.size[1], mounting_flangeVisual2.size[2], mounting_flangeVisual2.size[3]},
        {gripper_bodyVisual1.length, 2*gripper_bodyVisual1.radius, 2*gripper_bodyVisual1.radius},
        {gripper_bodyVisual2.size[1], gripper_bodyVisual2.size[2], gripper_bodyVisual2.size[3]},
        {gripper_bodyVisual3.size[1], gripper_bodyVisual3.size[2], gripper_bodyVisual3.size[3]},
        {gripper_bodyVisual4.size[1], gripper_bodyVisual4.size[2], gripper_bodyVisual4.size[3]},
        {finger_rightVisual1.size[1], finger_rightVisual1.size[2], finger_rightVisual1.size[3]},
        {finger_rightVisual2.size[1], finger_rightVisual2.size[2], finger_rightVisual2.size[3]},
        {1, 1, 1},
        {finger_rightVisual4.size[1], finger_rightVisual4.size[2], finger_rightVisual4.size[3]},
        {finger_leftVisual1.size[1], finger_leftVisual1.size[2], finger_leftVisual1.size[3]},
        {finger_leftVisual2.size[1], finger_leftVisual2.size[2], finger_leftVisual2.size[3]},
        {1, 1, 1},
        {finger_leftVisual4.size[1], finger_leftVisual4.size[2], finger_leftVisual4.size[3]},
        {1, 1, 1},
        {drive_pinionVisual2.length, 2*drive_pinionVisual2.radius, 2*drive_pinionVisual2.radius}},
      colors = {
        base_linkVisual1.color,
        base_linkVisual2.color,
        base_linkVisual3.color,
        base_linkVisual4.color,
        base_linkVisual5.color,
        base_linkVisual6.color,
        base_linkVisual7.color,
        carouselVisual1.color,
        carouselVisual2.color,
        carouselVisual3.color,
        upper_armVisual1.color,
        upper_armVisual2.color,
        upper_armVisual3.color,
        upper_armVisual4.color,
        upper_armVisual5.color,
        elbow_housingVisual1.color,
        elbow_housingVisual2.color,
        elbow_housingVisual3.color,
        elbow_housingVisual4.color,
        elbow_housingVisual5.color,
        forearmVisual1.color,
        forearmVisual2.color,
        forearmVisual3.color,
        forearmVisual4.color,
        forearmVisual5.color,
        forearmVisual6.color,
        wristVisual1.color,
        wristVisual2.color,
        mounting_flangeVisual1.color,
        mounting_flangeVisual2.color,
        gripper_bodyVisual1.color,
        gripper_bodyVisual2.color,
        gripper_bodyVisual3.color,
        gripper_bodyVisual4.color,
        finger_rightVisual1.color,
        finger_rightVisual2.color,
        finger_rightVisual3.color,
        finger_rightVisual4.color,
        finger_leftVisual1.color,
        finger_leftVisual2.color,
        finger_leftVisual3.color,
        finger_leftVisual4.color,
        drive_pinionVisual1.color,
        drive_pinionVisual2.color}));

  constant Integer turretAxis = 1
    "Number of joint \"turret\" in rotationalAxis";

  constant Integer shoulderAxis = 2
    "Number of joint \"shoulder\" in rotationalAxis";

  constant Integer elbowAxis = 3
    "Number of joint \"elbow\" in rotationalAxis";

  constant Integer forearm_rollAxis = 4
    "Number of joint \"forearm_roll\" in rotationalAxis";

  constant Integer wrist_pitchAxis = 5
    "Number of joint \"wrist_pitch\" in rotationalAxis";

  constant Integer flange_rollAxis = 6
    "Number of joint \"flange_roll\" in rotationalAxis";

  constant Integer gripper_strokeAxis = 1
    "Number of joint \"gripper_stroke\" in translationalAxis";

  UrdfSync.Records.Link base_link(
    name = "base_link",
    inertial(
      origin(
        xyz = {-0.008, 0, 0.0817},
        rpy = {0, 0, 0}),
      mass = 15.5,
      inertia(
        ixx = 0.09709,
        iyy = 0.111,
        izz = 0.10437,
        ixy = 0,
        ixz = 0.00041,
        iyz = 0)))
    "Link 1: \"base_link\"";

  UrdfSync.Records.Box base_linkVisual1(
    origin(
      xyz = {0, 0, 0.015},
      rpy = {0, 0, 0}),
    size = {0.26, 0.24, 0.03},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 1: \"foot\" of link \"base_link\"";

  UrdfSync.Records.Mesh base_linkVisual2(
    origin(
      xyz = {0, 0, 0.03},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/base_casting_d67b161a.stl",
    lower = {-0.11, -0.11, 0},
    upper = {0.11, 0.11, 0.17},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 2: \"casting\" of link \"base_link\"";

  UrdfSync.Records.Box base_linkVisual3(
    origin(
      xyz = {-0.1, 0, 0.085},
      rpy = {0, 0, 0}),
    size = {0.06, 0.11, 0.09},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"connector_panel\" of link \"base_link\"";

  UrdfSync.Records.Cylinder base_linkVisual4(
    origin(
      xyz = {0.11, 0.1, 0.036},
      rpy = {0, 0, 0}),
    radius = 0.009,
    length = 0.012,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 4: \"bolt_1\" of link \"base_link\"";

  UrdfSync.Records.Cylinder base_linkVisual5(
    origin(
      xyz = {-0.11, 0.1, 0.036},
      rpy = {0, 0, 0}),
    radius = 0.009,
    length = 0.012,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 5: \"bolt_2\" of link \"base_link\"";

  UrdfSync.Records.Cylinder base_linkVisual6(
    origin(
      xyz = {-0.11, -0.1, 0.036},
      rpy = {0, 0, 0}),
    radius = 0.009,
    length = 0.012,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 6: \"bolt_3\" of link \"base_link\"";

  UrdfSync.Records.Cylinder base_linkVisual7(
    origin(
      xyz = {0.11, -0.1, 0.036},
      rpy = {0, 0, 0}),
    radius = 0.009,
    length = 0.012,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 7: \"bolt_4\" of link \"base_link\"";

  UrdfSync.Records.Link carousel(
    name = "carousel",
    inertial(
      origin(
        xyz = {0.003, 0, 0.1141},
        rpy = {0, 0.382, 0}),
      mass = 11.5,
      inertia(
        ixx = 0.081982,
        iyy = 0.097568,
        izz = 0.044031,
        ixy = 0,
        ixz = -1.6e-05,
        iyz = 0)))
    "Link 2: \"carousel\"";

  UrdfSync.Records.Cylinder carouselVisual1(
    origin(
      xyz = {0, 0, 0.016},
      rpy = {0, 0, 0}),
    radius = 0.096,
    length = 0.03,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 1: \"turntable\" of link \"carousel\"";

  UrdfSync.Records.Mesh carouselVisual2(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/carousel_325c5c27.obj",
    lower = {-0.082, -0.058, 0},
    upper = {0.102, 0.058, 0.272},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 2: \"body\" of link \"carousel\"";

  UrdfSync.Records.Cylinder carouselVisual3(
    origin(
      xyz = {-0.098, 0, 0.076},
      rpy = {0, 0, 0}),
    radius = 0.042,
    length = 0.09,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"turret_motor\" of link \"carousel\"";

  UrdfSync.Records.Link upper_arm(
    name = "upper_arm",
    inertial(
      origin(
        xyz = {0, 0, 0.1949},
        rpy = {0, 0, 0}),
      mass = 10.5,
      inertia(
        ixx = 0.32715,
        iyy = 0.29181,
        izz = 0.05616,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 3: \"upper_arm\"";

  UrdfSync.Records.Mesh upper_armVisual1(
    origin(
      xyz = {0, 0.06, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/upper_arm_side_732fcd09.stl",
    lower = {-0.07400000095367432, 0, -0.07400000095367432},
    upper = {0.07400000095367432, 0.03800000064074993, 0.5019999742507935},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"side_left\" of link \"upper_arm\"";

  UrdfSync.Records.Mesh upper_armVisual2(
    origin(
      xyz = {0, -0.06, 0},
      rpy = {0, 0, 3.1415927}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/upper_arm_side_732fcd09.stl",
    lower = {-0.07400000095367432, 0, -0.07400000095367432},
    upper = {0.07400000095367432, 0.03800000064074993, 0.5019999742507935},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 2: \"side_right\" of link \"upper_arm\"";

  UrdfSync.Records.Box upper_armVisual3(
    origin(
      xyz = {0, 0, 0.195},
      rpy = {0, 0, 0}),
    size = {0.08, 0.124, 0.15},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"web\" of link \"upper_arm\"";

  UrdfSync.Records.Cylinder upper_armVisual4(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.042,
    length = 0.204,
    color = {0, 120, 153},
    opacity = 1)
    "Visual 4: \"shoulder_cap\" of link \"upper_arm\"";

  UrdfSync.Records.Cylinder upper_armVisual5(
    origin(
      xyz = {0, 0, 0.44},
      rpy = {1.5707963, 0, 0}),
    radius = 0.034,
    length = 0.204,
    color = {0, 120, 153},
    opacity = 1)
    "Visual 5: \"elbow_cap\" of link \"upper_arm\"";

  UrdfSync.Records.Link elbow_housing(
    name = "elbow_housing",
    inertial(
      origin(
        xyz = {0.0158, 0.0001, 0.0313},
        rpy = {0, 0, 0}),
      mass = 8,
      inertia(
        ixx = 0.020434,
        iyy = 0.051526,
        izz = 0.047097,
        ixy = 0.000145,
        ixz = -0.000213,
        iyz = -1.7e-05)))
    "Link 4: \"elbow_housing\"";

  UrdfSync.Records.Mesh elbow_housingVisual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/elbow_housing_4beb27d3.obj",
    lower = {-0.1, -0.056, -0.062},
    upper = {0.13, 0.056, 0.098},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"body\" of link \"elbow_housing\"";

  UrdfSync.Records.Cylinder elbow_housingVisual2(
    origin(
      xyz = {0.138, 0, 0.04},
      rpy = {0, 1.5707963, 0}),
    radius = 0.052,
    length = 0.024,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"bearing_ring\" of link \"elbow_housing\"";

  UrdfSync.Records.Cylinder elbow_housingVisual3(
    origin(
      xyz = {-0.12, 0.026, 0.05},
      rpy = {0, 1.5707963, 0}),
    radius = 0.023,
    length = 0.05,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"roll_motor\" of link \"elbow_housing\"";

  UrdfSync.Records.Cylinder elbow_housingVisual4(
    origin(
      xyz = {-0.115, -0.026, 0.05},
      rpy = {0, 1.5707963, 0}),
    radius = 0.023,
    length = 0.04,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 4: \"pitch_motor\" of link \"elbow_housing\"";

  UrdfSync.Records.Box elbow_housingVisual5(
    origin(
      xyz = {0.06, 0, 0.098},
      rpy = {0, 0, 0}),
    size = {0.07, 0.06, 0.004},
    color = {0, 120, 153},
    opacity = 1)
    "Visual 5: \"stripe\" of link \"elbow_housing\"";

  UrdfSync.Records.Link forearm(
    name = "forearm",
    inertial(
      origin(
        xyz = {0.1118, 0, 0},
        rpy = {0, 0, 0}),
      mass = 4.2,
      inertia(
        ixx = 0.005953,
        iyy = 0.029335,
        izz = 0.030752,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 5: \"forearm\"";

  UrdfSync.Records.Mesh forearmVisual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/forearm_tube_ca766f70.stl",
    lower = {0, -0.058, -0.058},
    upper = {0.17, 0.058, 0.058},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"tube\" of link \"forearm\"";

  UrdfSync.Records.Box forearmVisual2(
    origin(
      xyz = {0.18, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.024, 0.104, 0.06},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"bridge\" of link \"forearm\"";

  UrdfSync.Records.Box forearmVisual3(
    origin(
      xyz = {0.23, 0.043, 0},
      rpy = {0, 0, 0}),
    size = {0.08, 0.018, 0.056},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 3: \"fork_left\" of link \"forearm\"";

  UrdfSync.Records.Box forearmVisual4(
    origin(
      xyz = {0.23, -0.043, 0},
      rpy = {0, 0, 0}),
    size = {0.08, 0.018, 0.056},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 4: \"fork_right\" of link \"forearm\"";

  UrdfSync.Records.Cylinder forearmVisual5(
    origin(
      xyz = {0.27, 0.045, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.03,
    length = 0.022,
    color = {0, 120, 153},
    opacity = 1)
    "Visual 5: \"fork_cap_left\" of link \"forearm\"";

  UrdfSync.Records.Cylinder forearmVisual6(
    origin(
      xyz = {0.27, -0.045, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.03,
    length = 0.022,
    color = {0, 120, 153},
    opacity = 1)
    "Visual 6: \"fork_cap_right\" of link \"forearm\"";

  UrdfSync.Records.Link wrist(
    name = "wrist",
    inertial(
      origin(
        xyz = {0.0149, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1.3,
      inertia(
        ixx = 0.0007326,
        iyy = 0.001127,
        izz = 0.0011811,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 6: \"wrist\"";

  UrdfSync.Records.Cylinder wristVisual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.034,
    length = 0.066,
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"barrel\" of link \"wrist\"";

  UrdfSync.Records.Cylinder wristVisual2(
    origin(
      xyz = {0.034, 0, 0},
      rpy = {0, 1.5707963, 0}),
    radius = 0.03,
    length = 0.066,
    color = {230, 230, 222},
    opacity = 1)
    "Visual 2: \"nose\" of link \"wrist\"";

  UrdfSync.Records.Link mounting_flange(
    name = "mounting_flange",
    inertial(
      origin(
        xyz = {0.006, 0, 8e-05},
        rpy = {0, 0, 0}),
      mass = 0.22,
      inertia(
        ixx = 0.00010943,
        iyy = 5.763e-05,
        izz = 5.707e-05,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 7: \"mounting_flange\"";

  UrdfSync.Records.Cylinder mounting_flangeVisual1(
    origin(
      xyz = {0.006, 0, 0},
      rpy = {0, 1.5707963, 0}),
    radius = 0.0315,
    length = 0.012,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"plate\" of link \"mounting_flange\"";

  UrdfSync.Records.Box mounting_flangeVisual2(
    origin(
      xyz = {0.006, 0, 0.0315},
      rpy = {0, 0, 0}),
    size = {0.008, 0.004, 0.003},
    color = {0, 120, 153},
    opacity = 1)
    "Visual 2: \"zero_mark\" of link \"mounting_flange\"";

  UrdfSync.Records.Link tool0(
    name = "tool0",
    hasInertial = false)
    "Link 8: \"tool0\"";

  UrdfSync.Records.Link gripper_body(
    name = "gripper_body",
    inertial(
      origin(
        xyz = {0, 0, 0.0393},
        rpy = {0, 0, 0}),
      mass = 0.82,
      inertia(
        ixx = 0.0005742,
        iyy = 0.0011987,
        izz = 0.0011859,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 9: \"gripper_body\"";

  UrdfSync.Records.Cylinder gripper_bodyVisual1(
    origin(
      xyz = {0, 0, 0.006},
      rpy = {0, 0, 0}),
    radius = 0.0315,
    length = 0.012,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 1: \"adapter\" of link \"gripper_body\"";

  UrdfSync.Records.Box gripper_bodyVisual2(
    origin(
      xyz = {0, 0, 0.042},
      rpy = {0, 0, 0}),
    size = {0.12, 0.06, 0.06},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"housing\" of link \"gripper_body\"";

  UrdfSync.Records.Box gripper_bodyVisual3(
    origin(
      xyz = {0, 0.031, 0.042},
      rpy = {0, 0, 0}),
    size = {0.1, 0.004, 0.044},
    color = {0, 120, 153},
    opacity = 1)
    "Visual 3: \"cover_left\" of link \"gripper_body\"";

  UrdfSync.Records.Box gripper_bodyVisual4(
    origin(
      xyz = {0, -0.031, 0.042},
      rpy = {0, 0, 0}),
    size = {0.1, 0.004, 0.044},
    color = {0, 120, 153},
    opacity = 1)
    "Visual 4: \"cover_right\" of link \"gripper_body\"";

  UrdfSync.Records.Link finger_right(
    name = "finger_right",
    inertial(
      origin(
        xyz = {0.0131, -0.00166, 0.0344},
        rpy = {0, 0, 0}),
      mass = 0.13,
      inertia(
        ixx = 9.631e-05,
        iyy = 0.00010464,
        izz = 4.01e-05,
        ixy = -5.43e-06,
        ixz = 3.98e-06,
        iyz = -6.36e-06)))
    "Link 10: \"finger_right\"";

  UrdfSync.Records.Box finger_rightVisual1(
    origin(
      xyz = {-0.012, -0.0181, 0.005},
      rpy = {0, 0, 0}),
    size = {0.068, 0.008, 0.01},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"rack\" of link \"finger_right\"";

  UrdfSync.Records.Box finger_rightVisual2(
    origin(
      xyz = {0.0195, 0, 0.017},
      rpy = {0, 0, 0}),
    size = {0.037, 0.046, 0.014},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"carriage\" of link \"finger_right\"";

  UrdfSync.Records.Mesh finger_rightVisual3(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/finger_26f93e36.obj",
    lower = {0.004, -0.012, 0.024},
    upper = {0.034, 0.012, 0.096},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"blade\" of link \"finger_right\"";

  UrdfSync.Records.Box finger_rightVisual4(
    origin(
      xyz = {0.002, 0, 0.077},
      rpy = {0, 0, 0}),
    size = {0.004, 0.022, 0.032},
    color = {26, 26, 26},
    opacity = 1)
    "Visual 4: \"pad\" of link \"finger_right\"";

  UrdfSync.Records.Link grasp_point(
    name = "grasp_point",
    hasInertial = false)
    "Link 11: \"grasp_point\"";

  UrdfSync.Records.Link finger_left(
    name = "finger_left",
    inertial(
      origin(
        xyz = {0.0131, -0.00166, 0.0344},
        rpy = {0, 0, 0}),
      mass = 0.13,
      inertia(
        ixx = 9.631e-05,
        iyy = 0.00010464,
        izz = 4.01e-05,
        ixy = -5.43e-06,
        ixz = 3.98e-06,
        iyz = -6.36e-06)))
    "Link 12: \"finger_left\"";

  UrdfSync.Records.Box finger_leftVisual1(
    origin(
      xyz = {-0.012, -0.0181, 0.005},
      rpy = {0, 0, 0}),
    size = {0.068, 0.008, 0.01},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"rack\" of link \"finger_left\"";

  UrdfSync.Records.Box finger_leftVisual2(
    origin(
      xyz = {0.0195, 0, 0.017},
      rpy = {0, 0, 0}),
    size = {0.037, 0.046, 0.014},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"carriage\" of link \"finger_left\"";

  UrdfSync.Records.Mesh finger_leftVisual3(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/finger_26f93e36.obj",
    lower = {0.004, -0.012, 0.024},
    upper = {0.034, 0.012, 0.096},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"blade\" of link \"finger_left\"";

  UrdfSync.Records.Box finger_leftVisual4(
    origin(
      xyz = {0.002, 0, 0.077},
      rpy = {0, 0, 0}),
    size = {0.004, 0.022, 0.032},
    color = {26, 26, 26},
    opacity = 1)
    "Visual 4: \"pad\" of link \"finger_left\"";

  UrdfSync.Records.Link drive_pinion(
    name = "drive_pinion",
    inertial(
      origin(
        xyz = {0, 0, 0.00183},
        rpy = {0, 0, 0}),
      mass = 0.045,
      inertia(
        ixx = 3.4535e-06,
        iyy = 3.4535e-06,
        izz = 2.5842e-06,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 13: \"drive_pinion\"";

  UrdfSync.Records.Mesh drive_pinionVisual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/drive_pinion_006c7beb.stl",
    lower = {-0.013737000465393067, -0.013737000465393067, 0},
    upper = {0.013737000465393067, 0.013737000465393067, 0.01},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"gear\" of link \"drive_pinion\"";

  UrdfSync.Records.Cylinder drive_pinionVisual2(
    origin(
      xyz = {0, 0, -0.005},
      rpy = {0, 0, 0}),
    radius = 0.005,
    length = 0.028,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"shaft\" of link \"drive_pinion\"";

  UrdfSync.Records.RevoluteJoint turret(
    name = "turret",
    origin(
      xyz = {0, 0, 0.2},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -2.967,
      upper = 2.967,
      velocity = 5,
      effort = 180),
    dynamics(
      damping = 12,
      friction = 9),
    transmission(
      reduction = 101,
      offset = 0),
    calibration(
      rising = 0,
      falling = Modelica.Constants.inf),
    safetyController(
      k_velocity = 80,
      k_position = 60,
      soft_lower_limit = -2.88,
      soft_upper_limit = 2.88))
    "Joint 1: \"turret\"";

  UrdfSync.Records.RevoluteJoint shoulder(
    name = "shoulder",
    origin(
      xyz = {0.03, 0, 0.2},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -1.658,
      upper = 2.269,
      velocity = 4.4,
      effort = 280),
    dynamics(
      damping = 15,
      friction = 11),
    calibration(
      rising = 0,
      falling = Modelica.Constants.inf),
    safetyController(
      k_velocity = 110,
      k_position = 60,
      soft_lower_limit = -1.57,
      soft_upper_limit = 2.18))
    "Joint 2: \"shoulder\"";

  UrdfSync.Records.RevoluteJoint elbow(
    name = "elbow",
    origin(
      xyz = {0, 0, 0.44},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -3.49,
      upper = 1.222,
      velocity = 5,
      effort = 130),
    dynamics(
      damping = 8,
      friction = 6.5),
    calibration(
      rising = 0,
      falling = Modelica.Constants.inf),
    safetyController(
      k_velocity = 50,
      k_position = 60,
      soft_lower_limit = -3.4,
      soft_upper_limit = 1.13))
    "Joint 3: \"elbow\"";

  UrdfSync.Records.RevoluteJoint forearm_roll(
    name = "forearm_roll",
    origin(
      xyz = {0.15, 0, 0.04},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -4.712,
      upper = 4.712,
      velocity = 7,
      effort = 34),
    dynamics(
      damping = 1.2,
      friction = 1.6))
    "Joint 4: \"forearm_roll\"";

  UrdfSync.Records.RevoluteJoint wrist_pitch(
    name = "wrist_pitch",
    origin(
      xyz = {0.27, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -2.182,
      upper = 2.182,
      velocity = 7,
      effort = 26),
    dynamics(
      damping = 0.9,
      friction = 1.3))
    "Joint 5: \"wrist_pitch\"";

  UrdfSync.Records.RevoluteJoint flange_roll(
    name = "flange_roll",
    origin(
      xyz = {0.068, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -6.981,
      upper = 6.981,
      velocity = 10.5,
      effort = 13),
    dynamics(
      damping = 0.35,
      friction = 0.7))
    "Joint 6: \"flange_roll\"";

  UrdfSync.Records.FixedJoint flange_to_tool(
    name = "flange_to_tool",
    origin(
      xyz = {0.012, 0, 0},
      rpy = {0, 1.5707963, 0}))
    "Joint 7: \"flange_to_tool\"";

  UrdfSync.Records.FixedJoint gripper_mount(
    name = "gripper_mount",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}))
    "Joint 8: \"gripper_mount\"";

  UrdfSync.Records.PrismaticJoint finger_coupling(
    name = "finger_coupling",
    origin(
      xyz = {0, 0, 0.074},
      rpy = {0, 0, 3.1415927}),
    axis = {1, 0, 0},
    limits(
      lower = 0,
      upper = 0.035,
      velocity = 0.12,
      effort = 140),
    dynamics(
      damping = 25,
      friction = 5),
    mimic(
      multiplier = 1,
      offset = 0))
    "Joint 9: \"finger_coupling\"";

  UrdfSync.Records.FixedJoint grasp_frame(
    name = "grasp_frame",
    origin(
      xyz = {0, 0, 0.151},
      rpy = {0, 0, 0}))
    "Joint 10: \"grasp_frame\"";

  UrdfSync.Records.PrismaticJoint gripper_stroke(
    name = "gripper_stroke",
    origin(
      xyz = {0, 0, 0.074},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = 0,
      upper = 0.035,
      velocity = 0.12,
      effort = 140),
    dynamics(
      damping = 25,
      friction = 5))
    "Joint 11: \"gripper_stroke\"";

  UrdfSync.Records.RevoluteJoint pinion_coupling(
    name = "pinion_coupling",
    origin(
      xyz = {0, 0, 0.074},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -0.05,
      upper = 2.85,
      velocity = 9.6,
      effort = 1.75),
    dynamics(
      damping = 0.0005,
      friction = 0.005),
    mimic(
      multiplier = 80,
      offset = 0))
    "Joint 12: \"pinion_coupling\"";

  annotation (Documentation(info="<html>
<p>
All numbers of robot SixAxisArm in one record, with the tables by which <code>UrdfSync.Robots.GenericRobot</code> reads how links and joints hang together. The tables refer to the numbers below them. Where the package has models of the links and joints, these read the records of their elements, and the numbers here are a copy: an edit here changes no such model.
</p>
</html>"),
    __urdfsync(id = "18d63be1-d6f1", base = "7ca9031a7d1eb8a2"));
end SixAxisArmParameters;
