use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::{JointKind, MeshPathError, ShapeDescription, mesh_location, parse};
use crate::Source;

const ARM: &str = r#"<?xml version="1.0"?>
<!-- <link name="no"/> -->
<robot name="arm">
  <link name="base"/>
  <link name="one">
    <inertial><origin xyz="0 0 0.1" rpy="0 0 1"/><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0" izz="3"/></inertial>
    <collision><origin xyz="1 2 3"/><geometry><cylinder radius="0.1" length="0.5"/></geometry></collision>
    <collision><geometry><capsule radius="0.2" length="0.4"/></geometry></collision>
    <visual><geometry><mesh filename="package://arm/one.stl" scale="0.001 0.001 0.001"/></geometry></visual>
  </link>
  <link name="two"/>
  <joint name="j1" type="revolute">
    <origin xyz="0 0 0.3" rpy="0 0.5 0"/><parent link="base"/><child link="one"/><axis xyz="0 3 4"/>
    <limit lower="-1" upper="2" velocity="3" effort="0"/>
  </joint>
  <joint name="j2" type="continuous">
    <parent link="one"/><child link="two"/><axis xyz="0 0 1"/><limit velocity="3" effort="7"/>
  </joint>
</robot>
"#;

fn problems(text: &str) -> Vec<String> {
    let source = Source::new("r.urdf", text);
    let problems = parse(&source).expect_err("must be refused");
    source.fancy(&problems, false);
    problems.iter().map(|problem| source.plain(problem).to_string()).collect()
}

#[test]
fn arm_is_read() {
    let robot = parse(&Source::new("r.urdf", ARM)).unwrap();
    assert_eq!((robot.name.as_str(), robot.links.len(), robot.joints.len()), ("arm", 3, 2));
    assert_eq!((robot.links[0].mass_kg, robot.links[1].mass_kg), (None, Some(2.0)));
    let one = &robot.links[1];
    assert_eq!((one.com_m, one.inertial_rpy_rad), ([0.0, 0.0, 0.1], [0.0, 0.0, 1.0]));
    assert_eq!(one.inertia, [1.0, 0.0, 0.0, 2.0, 0.0, 3.0]);
    assert_eq!(one.collisions[0].xyz_m, [1.0, 2.0, 3.0]);
    assert_eq!(
        one.collisions[0].shape,
        ShapeDescription::Cylinder { radius_m: 0.1, length_m: 0.5 }
    );
    assert_eq!(one.collisions[1].shape, ShapeDescription::Capsule { radius_m: 0.2, length_m: 0.4 });
    let mesh =
        ShapeDescription::Mesh { path: "package://arm/one.stl".to_owned(), scale: [0.001; 3] };
    assert_eq!(one.visuals[0].shape, mesh);
    let (j1, j2) = (&robot.joints[0], &robot.joints[1]);
    assert_eq!((j1.kind, j1.axis, j1.effort), (JointKind::Revolute, [0.0, 0.6, 0.8], None));
    assert_eq!((j1.lower, j1.upper, j1.velocity), (Some(-1.0), Some(2.0), Some(3.0)));
    assert_eq!((j2.kind, j2.lower, j2.effort), (JointKind::Continuous, None, Some(7.0)));
}

#[test]
fn broken_robots_are_refused_at_their_place() {
    for (from, to, expected) in [
        (r#"xyz="1 2 3""#, r#"xyz="1 x 2 3""#, "7:29: |xyz of <origin>: \"x\" is not a number"),
        (r#"xyz="1 2 3""#, r#"xyz="1 2""#, "7:29: |needs 3 numbers, has 2"),
        (r#"xyz="1 2 3""#, r#"xyz="1 2 inf""#, "7:29: |\"inf\" is not finite"),
        (r#"velocity="3" effort="0""#, r#"velocity="NaN""#, "14:|\"NaN\" is not finite"),
        (r#"value="2""#, r#"value="-2""#, "6:|must not be negative"),
        (r#"radius="0.1""#, r#"radius="0""#, "7:|must be positive"),
        (r#"value="2""#, r#"value="0""#, "6:50: |a body with inertia has a mass above 0"),
        (
            r#"izz="3""#,
            r#"izz="3.02""#,
            "6:67: |principal moments of 1.0000, 2.0000 and 3.0200 kg m²",
        ),
        (r#"ixy="0""#, r#"ixy="-1.5""#, "6:67: |principal moments of -0.0811, 3.0000 and 3.0811"),
        (r#"iyz="0""#, r#"iyz="1""#, "6:67: |no body has"),
        (r#"ixx="1""#, r#"ixx="one""#, "6:|ixx of <inertia>: \"one\" is not a number"),
        (r#"<mass value="2"/>"#, "", "mass"),
        (r#"scale="0.001 0.001 0.001""#, r#"scale="1 1 0""#, "must not be zero"),
        (r#"xyz="0 3 4""#, r#"xyz="0 0 0""#, "13:|must not be zero"),
        (
            r#"type="continuous""#,
            r#"type="planar""#,
            "16:26: |type \"planar\"|the twin knows revolute",
        ),
        (r#"name="j2""#, r#"name="j1""#, "16:16: |a second joint \"j1\""),
        (r#"<link name="two"/>"#, r#"<link name="one"/>"#, "11:15: |a second link \"one\""),
        (
            r#"<parent link="base"/>"#,
            r#"<parent link="basis"/>"#,
            "12:16: |no parent link \"basis\"",
        ),
        (r#"<parent link="base"/>"#, "", "not a URDF"),
        (r#"lower="-1""#, r#"lower="3""#, "12:16: |lower limit 3 is above upper limit 2"),
        (r#"<limit velocity="3" effort="7"/>"#, "", "16:16: |no velocity limit"),
        (
            r#"<child link="two"/>"#,
            r#"<child link="one"/>"#,
            "11:15: |two roots: \"two\" and \"base\"",
        ),
        (
            "</robot>",
            r#"<joint name="j3" type="fixed"><parent link="base"/><child link="two"/></joint></robot>"#,
            "19:14: |link \"two\" has two parents",
        ),
        (r#"<link name="two"/>"#, r#"<link name="two"/><link name="loose"/>"#, "11:33: |two roots"),
        (r#"<parent link="base"/>"#, r#"<parent link="two"/>"#, "5:15: |cycle"),
        (
            r#"<axis xyz="0 0 1"/>"#,
            r#"<mimic joint="j9"/>"#,
            "16:16: |follows \"j9\", which does not exist",
        ),
        ("<!--", "<!DOCTYPE x [<!ENTITY a \"b\">]><!--", "2:1: |DOCTYPE"),
        ("</robot>", "", "3:1: |<robot> is never closed"),
        ("</robot>", "</robt>", "19:1: |closes nothing"),
        (r#"name="arm""#, "name=arm", "3:1: |not well formed"),
        ("<robot", "<sdf", "closes nothing"),
        (r#"<link name="two"/>"#, "<xacro:foo/>", "11:3: |xacro"),
        (r#"<link name="two"/>"#, "<link/>", "11:3: |<link> has no name"),
    ] {
        let text = ARM.replacen(from, to, 1);
        assert_ne!(text, ARM);
        let found = problems(&text);
        assert!(expected.split('|').all(|part| found[0].contains(part)), "{expected}: {found:#?}");
    }
    for (text, expected) in [
        ("", "no XML element"),
        ("solid", "no XML element"),
        ("<a/><b/>", "second root"),
        ("<", "without a name"),
    ] {
        assert!(problems(text)[0].contains(expected), "{text}: {:?}", problems(text));
    }
    assert!(problems(&"<a>".repeat(1_000_000))[0].contains("nested deeper"));
    assert!(problems("<robot name='r'></robot>")[0].contains("no link"));
}

#[test]
fn a_mass_of_nothing_is_none() {
    let inertial = &ARM[ARM.find("<inertia ").unwrap()..ARM.find("</inertial>").unwrap()];
    let zero = r#"<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/>"#;
    let text = ARM.replace(inertial, zero);
    assert_eq!(parse(&Source::new("r", text.as_str())).unwrap().links[1].mass_kg, Some(2.0));
    let text = text.replace(r#"value="2""#, r#"value="0""#);
    assert_eq!(parse(&Source::new("r", text)).unwrap().links[1].mass_kg, None);
    // A thin plate, as published with three digits.
    let plate = r#"<inertia ixx="0.333" ixy="0" ixz="0" iyy="0.167" iyz="0" izz="0.501"/>"#;
    assert!(parse(&Source::new("r", ARM.replace(inertial, plate))).is_ok());
}

#[test]
fn cuts_and_swaps_never_panic() {
    for at in 0..ARM.len() {
        let _ = parse(&Source::new("r", &ARM[..at]));
        for letter in ["<", "\"", "/", "é", "&"] {
            let text = format!("{}{letter}{}", &ARM[..at], &ARM[at + 1..]);
            if at % 3 == 0 {
                let _ = parse(&Source::new("r", text));
            }
        }
    }
}

#[test]
fn vendors_files_are_read() {
    let shared = std::env::var("TWIN_SHARED")
        .unwrap_or_else(|_| concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared").to_owned());
    let folder = Path::new(&shared).join("data/robots/urdf");
    let Ok(files) = std::fs::read_dir(&folder) else {
        #[allow(clippy::print_stderr)] // a skipped test must be seen
        {
            eprintln!("skipped: no {}", folder.display());
        }
        return;
    };
    let mut count = 0;
    for file in files
        .map(|file| file.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "urdf"))
    {
        let source =
            Source::new(file.display().to_string(), std::fs::read_to_string(&file).unwrap());
        let robot = parse(&source).unwrap_or_else(|problems| {
            let shown: Vec<_> =
                problems.iter().map(|each| source.plain(each).to_string()).collect();
            panic!("{shown:#?}")
        });
        assert!(robot.joints.iter().filter(|joint| joint.kind == JointKind::Revolute).count() >= 6);
        count += 1;
    }
    assert_eq!(count, 6);
}

#[test]
fn meshes_stay_in_the_named_folders() {
    let packages = BTreeMap::from([("arm".to_owned(), PathBuf::from("/ws/arm/."))]);
    let at = |path: &str, dir: &str| mesh_location(path, &packages, Path::new(dir));
    for (path, dir, expected) in [
        ("package://arm/meshes/../m/a.stl", "/x/urdf", "/ws/arm/m/a.stl"),
        ("package://arm//a.stl", "/x/urdf", "/ws/arm/a.stl"),
        ("meshes/a.stl", "/x/urdf", "/x/urdf/meshes/a.stl"),
        ("../meshes/./a.stl", "/x/urdf", "/x/meshes/a.stl"),
        ("file:///ws/arm/a.stl", "/x/urdf", "/ws/arm/a.stl"),
        ("/x/meshes/a.stl", "/x/urdf", "/x/meshes/a.stl"),
        ("a.stl", "", "a.stl"),
        ("../a.stl", "", "../a.stl"),
        ("../a.stl", "robots/urdf", "robots/a.stl"),
    ] {
        assert_eq!(at(path, dir), Ok(PathBuf::from(expected)), "{path} in {dir}");
    }
    for (path, dir) in [
        ("package://arm/../../etc/passwd", "/x/urdf"),
        ("package://arm/", "/x/urdf"),
        ("../../etc/passwd", "/x/urdf"),
        ("/etc/passwd", "/x/urdf"),
        ("file:///x2/a.stl", "/x/urdf"),
        ("../../a.stl", ""),
        ("../../../a.stl", "urdf"),
        ("../../a.stl", "."),
    ] {
        assert!(matches!(at(path, dir), Err(MeshPathError::Outside { .. })), "{path} in {dir}");
    }
    assert!(matches!(at("package://other/a.stl", "/x"), Err(MeshPathError::UnknownPackage { .. })));
    for path in ["http://x/a.stl", "", " ", "a\0b", "package://arm"] {
        assert!(matches!(at(path, "/x"), Err(MeshPathError::Unsupported { .. })), "{path}");
    }
}
