//! Tests that this reader agrees with MuJoCo 4.0: it accepts the same models or refuses them with a reason.

use super::{checked_names, distance_from_link, file_of, largest_difference};
use crate::remark::CellRemark;
use crate::robot::Robot;
use crate::robot_file::{BodyElements, MeshConversion, RobotFile};
use rigid_ccd::glam::{DAffine3, DVec3};
use std::f64::consts::PI;

const TETRAHEDRON: &str = r#"vertex="0 0 0 .5 0 0 0 .5 0 0 0 .5""#;

fn read(text: &str) -> Robot {
    file_of(text)
        .read()
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// Returns the error of reading a model or its pairs.
fn refusal(text: &str) -> String {
    let file = file_of(text);
    let read = file.read().and_then(|robot| file.link_pairs(&robot, None));
    match read {
        Err(error) => error.to_string(),
        Ok(_) => panic!("{text} is read"),
    }
}

/// Returns a model of a body `s` with a slide joint `x` and a geom, and further sections.
fn slide(joint: &str, geom: &str, sections: &str) -> String {
    format!(
        r#"<mujoco>{sections}<worldbody><body name="s"><joint name="x" type="slide" {joint}/><geom {geom}/></body></worldbody>
        </mujoco>"#
    )
}

fn class(content: &str) -> String {
    format!(r#"<default><default class="m">{content}</default></default>"#)
}

/// Tests that empty numeric attributes do not replace those of a class.
#[test]
fn empty_numbers_are_those_of_the_class() {
    let joint = r#"<joint axis="1 0 0" range="0 1" ref=".5"/>"#;
    let mesh = format!(r#"<asset><mesh name="m" class="m" {TETRAHEDRON} SCALE/></asset>"#);
    for (of_class, empty) in [
        (r#"<geom size=".1" pos=".5 0 0"/>"#, r#"pos="""#),
        (r#"<geom size=".1" pos=".5 0 0"/>"#, r#"pos=" ""#),
        (
            r#"<geom size=".1" type="capsule" fromto="0 0 0 1 0 0"/>"#,
            r#"fromto="""#,
        ),
        (
            r#"<geom type="box" size="1 2 3" quat="1 1 0 0"/>"#,
            r#"quat="""#,
        ),
        (
            r#"<geom type="box" size="1 2 3" quat="1 1 0 0"/>"#,
            r#"euler="""#,
        ),
        (
            r#"<geom type="box" size="1 2 3" euler="9 9 0"/>"#,
            r#"euler="""#,
        ),
        (r#"<geom type="box" size="1 2 3"/>"#, r#"size="""#),
        (
            r#"<geom size=".1" contype="0" conaffinity="2"/>"#,
            r#"contype="" conaffinity="""#,
        ),
    ] {
        let with = |own: &str| {
            let geom = format!(r#"class="m" {own}"#);
            slide("", &geom, &class(of_class))
        };
        let [given, empty] = ["", empty].map(|own| format!("{:?}", read(&with(own))));
        assert!(given == empty, "{of_class}");
    }
    for empty in [r#"axis="""#, r#"axis=" ""#, r#"range="""#, r#"ref="""#] {
        let with = |own: &str| {
            read(&slide(
                &format!(r#"class="m" {own}"#),
                r#"size="1""#,
                &class(joint),
            ))
        };
        assert_eq!(format!("{:?}", with("")), format!("{:?}", with(empty)));
    }
    let scaled = class(r#"<mesh scale="2 2 2"/>"#);
    let with = |own: &str| {
        let sections = scaled.clone() + &mesh.replace("SCALE", own);
        format!(
            "{:?}",
            read(&slide("", r#"type="mesh" mesh="m""#, &sections))
        )
    };
    assert!(with("") == with(r#"scale="""#));
    let masks = r#"<mujoco><worldbody><geom size="1"/><body name="b"><joint/><geom size="1" contype="" conaffinity=""/></body>
        </worldbody></mujoco>"#;
    assert_eq!(checked_names(masks, BodyElements::Collision), ["b world"]);
}

#[test]
fn words_are_taken_as_they_are() {
    for (text, expected) in [
        (slide("", r#"size="1" type="""#, ""), "type=\"\""),
        (
            slide("", r#"size="1 1 1" type=" box ""#, ""),
            "type=\" box \"",
        ),
        (slide("", r#"size="1" class="""#, ""), "no class ``"),
        (
            slide("", r#"size="1" class=" m""#, &class("<geom/>")),
            "no class ` m`",
        ),
        (
            slide(r#"limited=" true " range="0 1""#, r#"size="1""#, ""),
            "limited=\" true \"",
        ),
        (
            slide("", r#"size="1""#, r#"<compiler eulerseq=""/>"#),
            "eulerseq=\"\"",
        ),
        (
            slide("", r#"size="1""#, r#"<compiler angle=""/>"#),
            "angle=\"\"",
        ),
        (
            slide(
                "",
                r#"size="1""#,
                r#"<option><flag filterparent=""/></option>"#,
            ),
            "filterparent=\"\"",
        ),
        (
            slide("", r#"size="1" pos="1&#160;2 3""#, ""),
            "pos=\"1\u{a0}2 3\"",
        ),
        (
            slide("", r#"size="1" contype="4294967296""#, ""),
            "contype=\"4294967296\"",
        ),
        (
            r#"<mujoco><worldbody><body childclass=""/></worldbody></mujoco>"#.to_owned(),
            "no class ``",
        ),
        (
            r#"<mujoco><worldbody><body mocap="1"/></worldbody></mujoco>"#.to_owned(),
            "mocap=\"1\"",
        ),
    ] {
        let message = refusal(&text);
        assert!(message.contains(expected), "{text}: {message}");
    }
    // Names that differ by a space are different.
    let sections = format!(
        r#"<asset><mesh name="m" {TETRAHEDRON} scale="9 9 9"/><mesh name="m " {TETRAHEDRON}/></asset>{}"#,
        r#"<default><default class="c"><geom pos="1 0 0"/></default><default class=" c"/></default>"#
    );
    let robot = read(&slide("", r#"type="mesh" mesh="m " class=" c""#, &sections));
    let link_body = &robot.links()[robot.link_number("s").unwrap()].bodies[0];
    assert!(link_body.body.bounding_radius() < 1.0);
    assert_eq!(link_body.pose.translation(), DVec3::ZERO);
}

/// Tests that joints of frames that MuJoCo would move to the center of mass are refused.
#[test]
fn frames_that_are_aligned_with_the_inertia_are_refused() {
    let free = |compiler: &str, joint: &str, child: &str| {
        format!(
            r#"<mujoco><compiler {compiler}/><worldbody><geom size=".1"/><body name="a">{joint}<geom size=".1" pos="1 0 0"/>{child}
            </body></worldbody></mujoco>"#
        )
    };
    let aligns = r#"alignfree="true""#;
    for (compiler, joint) in [
        ("", r#"<freejoint align="true"/>"#),
        (aligns, "<freejoint/>"),
        (aligns, r#"<freejoint align="auto"/>"#),
        (aligns, r#"<joint type="free"/>"#),
    ] {
        let message = refusal(&free(compiler, joint, ""));
        assert!(message.contains("body `a` is aligned"), "{message}");
        // MuJoCo moves only frames of bodies without children.
        let child = r#"<frame pos="0 0 1"><body><geom size="1"/></body></frame>"#;
        read(&free(compiler, joint, child));
    }
    for (compiler, joint) in [
        ("", "<freejoint/>"),
        ("", r#"<joint type="free"/>"#),
        (aligns, r#"<freejoint align="false"/>"#),
    ] {
        read(&free(compiler, joint, ""));
    }
    assert!(refusal(&free("", r#"<freejoint align="yes"/>"#, "")).contains("align=\"yes\""));
}

/// Tests that a z axis reversed up to rounding is rotated about x.
#[test]
fn half_turns_are_about_the_x_axis() {
    let half_turn = DAffine3::from_rotation_x(PI);
    for (own, expected) in [
        (r#"zaxis="6e-17 6e-17 -1" size="1 1 1""#, half_turn),
        (r#"zaxis="0 0 -1" size="1 1 1""#, half_turn),
        (r#"zaxis="6e-17 6e-17 1" size="1 1 1""#, DAffine3::IDENTITY),
        (r#"fromto="0 0 -1 6e-17 6e-17 1" size="1""#, half_turn),
        (r#"fromto="0 0 1 0 0 -1" size="1""#, DAffine3::IDENTITY),
    ] {
        let robot = read(&slide("", &format!(r#"type="box" {own}"#), ""));
        let link_body = &robot.links()[robot.link_number("s").unwrap()].bodies[0];
        assert!(largest_difference(link_body.pose, expected) < 1e-9, "{own}");
    }
}

#[test]
fn vectors_without_a_direction_are_refused() {
    let geom = |own: &str| slide("", &format!(r#"type="capsule" size="1 1" {own}"#), "");
    for (text, expected) in [
        (
            slide(r#"axis="1e308 0 0""#, r#"size="1""#, ""),
            "axis=\"1e308 0 0\"",
        ),
        (slide(r#"axis="1e-320 0 0""#, r#"size="1""#, ""), "axis"),
        (geom(r#"quat="0 1e-16 0 0""#), "quat"),
        (geom(r#"quat="0 1e200 0 0""#), "quat"),
        (geom(r#"zaxis="0 0 1e-13""#), "zaxis"),
        (geom(r#"axisangle="0 0 1e200 5""#), "axisangle"),
        (geom(r#"xyaxes="1e-12 0 0 0 1 0""#), "xyaxes"),
        (geom(r#"fromto="0 0 0 0 0 1e-14""#), "fromto"),
    ] {
        let message = refusal(&text);
        assert!(
            message.contains(expected) && message.ends_with("is not valid"),
            "{message}"
        );
    }
}

/// Tests that hulls contain vertices without a face, and exact meshes do not.
#[test]
fn hulls_contain_all_vertices() {
    let folder = tempfile::tempdir().unwrap();
    let obj =
        "v 0 0 0\nv .5 0 0\nv 0 .5 0\nv 0 0 .5\nv .9 0 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    std::fs::write(folder.path().join("m.obj"), obj).unwrap();
    let given = r#"<mesh name="m" vertex="0 0 0 .5 0 0 0 .5 0 0 0 .5 .9 0 0" face="0 2 1 0 1 3 1 2 3 2 0 3"/>"#;
    for mesh in [given, r#"<mesh file="m.obj"/>"#] {
        let text = slide(
            "",
            r#"type="mesh" mesh="m""#,
            &format!("<asset>{mesh}</asset>"),
        );
        let file = RobotFile::from_text(text, folder.path().join("model.xml"));
        let distance = |file: &RobotFile| {
            let robot = file.read().unwrap();
            distance_from_link(&robot, "s", DVec3::new(0.85, 0.0, 0.0))
        };
        assert!(distance(&file) > 0.3, "{mesh}");
        let hull = file.with_mesh_conversion(MeshConversion::OuterHull);
        assert!(distance(&hull) < 1e-6, "{mesh}");
    }
}

#[test]
fn vertices_with_fourth_numbers_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v 0 0 0 2\nv .5 0 0\nv 0 .5 0\nv 0 0 .5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    let text = slide(
        "",
        r#"type="mesh" mesh="m""#,
        r#"<asset><mesh file="m.obj"/></asset>"#,
    );
    let file = RobotFile::from_text(text, folder.path().join("model.xml"));
    std::fs::write(folder.path().join("m.obj"), obj).unwrap();
    let error = file.read().unwrap_err().to_string();
    assert!(
        error.starts_with("link `s`: geom `0`: a mesh whose vertices have a fourth number"),
        "{error}"
    );
    std::fs::write(folder.path().join("m.obj"), obj.replace(" 2\nv", " 1\nv")).unwrap();
    file.read().unwrap();
}

#[test]
fn flags_switch_equalities_and_limits_off() {
    let text = |flag: &str| {
        format!(
            r#"<mujoco><option><flag {flag}/></option><worldbody><body><joint name="p" range="0 1"/><geom size="1"/>
            <body><joint name="q" range="0 1"/><geom size="1"/></body></body></worldbody>
            <equality><joint joint1="q" joint2="p"/><weld body1="body1"/></equality></mujoco>"#
        )
    };
    for (flag, joints, is_limited, remarks) in [
        ("", 1, true, 1),
        (r#"equality="disable""#, 2, true, 0),
        (r#"limit="disable""#, 1, false, 1),
        (r#"constraint="disable""#, 2, false, 0),
        (
            r#"equality="enable" limit="enable" constraint="enable""#,
            1,
            true,
            1,
        ),
    ] {
        let text = text(flag).replace(r#"range="0 1""#, r#"range="0 57.29577951308232""#);
        let robot = read(&text);
        assert_eq!(robot.independent_joint_names().count(), joints, "{flag}");
        let limited = robot.limits().all(|[_, high]| high < f64::INFINITY);
        assert_eq!(limited, is_limited, "{flag}");
        assert_eq!(
            robot.file_remarks().len(),
            remarks,
            "{flag}: {:?}",
            robot.file_remarks()
        );
    }
    assert!(refusal(&text(r#"limit="off""#)).contains("limit=\"off\""));
}

#[test]
fn an_empty_folder_of_meshes_is_that_of_the_model() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v 0 0 0\nv .5 0 0\nv 0 .5 0\nv 0 0 .5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    std::fs::create_dir(folder.path().join("m1")).unwrap();
    std::fs::write(folder.path().join("a.obj"), obj).unwrap();
    std::fs::write(folder.path().join("m1/a.obj"), obj.replace(".5", "5")).unwrap();
    for (compilers, radius) in [
        (r#"<compiler meshdir="m1"/>"#, 5.0),
        (r#"<compiler meshdir="m1"/><compiler meshdir=""/>"#, 0.5),
        (r#"<compiler assetdir="m1" meshdir=""/>"#, 0.5),
        (r#"<compiler meshdir="m1"/><compiler assetdir=""/>"#, 0.5),
    ] {
        let sections = format!(r#"{compilers}<asset><mesh file="a.obj"/></asset>"#);
        let text = slide("", r#"type="mesh" mesh="a""#, &sections);
        let file = RobotFile::from_text(text, folder.path().join("model.xml"));
        let robot = file.read().unwrap();
        let link_body = &robot.links()[robot.link_number("s").unwrap()].bodies[0];
        assert!(
            (link_body.body.bounding_radius() / radius - 1.0).abs() < 0.5,
            "{compilers}"
        );
    }
}

#[test]
fn margins_are_remarked_upon() {
    let text = |first: &str, pair: &str, option: &str| {
        format!(
            r#"<mujoco>{option}<worldbody><geom name="a" size=".1"/><body><joint/><geom name="b" size=".1" {first}/>
            <geom size=".1" contype="0" conaffinity="0" margin="1"/></body></worldbody>
            <contact><pair geom1="a" geom2="b" {pair}/></contact></mujoco>"#
        )
    };
    let margin = r#"margin=".5""#;
    let over = r#"<option o_margin=".1"><flag override="enable"/></option>"#;
    for (text, expected) in [
        (text("", "", ""), None),
        (text(r#"margin="0""#, "", ""), None),
        (text(margin, "", ""), Some("margin of geom b")),
        (text("", margin, ""), Some("margin of pair")),
        (
            text(margin, margin, ""),
            Some("margin of geom b and 1 more"),
        ),
        (text("", "", over), Some("margin of geom a and 2 more")),
        (text(margin, "", &over.replace(".1", "0")), None),
    ] {
        let message: Vec<String> = read(&text)
            .file_remarks()
            .iter()
            .map(ToString::to_string)
            .collect();
        let is_expected = match expected {
            None => message.is_empty(),
            Some(expected) => message.len() == 1 && message[0].ends_with(expected),
        };
        assert!(is_expected, "{text}: {message:?}");
    }
}

#[test]
fn a_pair_of_two_geoms_of_a_body_is_refused() {
    let text = r#"<mujoco><worldbody><body name="s"><joint/><geom name="a" size="1"/><geom name="b" size="1"/></body></worldbody>
        <contact><pair name="p" geom1="a" geom2="b"/></contact></mujoco>"#;
    let expected = "an element `pair p` has two geoms of the body `s`; leave it out of the file";
    assert_eq!(refusal(text), expected);
}

/// Tests that names of one kind are unique, and that different kinds may share a name.
#[test]
fn names_are_not_repeated() {
    let mesh = format!(r#"<mesh name="n" {TETRAHEDRON}/>"#);
    let field = r#"<hfield name="n" nrow="2" ncol="2" size="1 1 1 1"/>"#;
    let ball = r#"<geom name="n" size="1"/>"#;
    let text = |sections: &str, world: &str| {
        format!(
            r#"<mujoco>{sections}<worldbody>{world}<body name="a"><joint name="a"/><geom name="a" size="1"/></body><geom name="b" size="1"/>
            </worldbody></mujoco>"#
        )
    };
    read(&text(&format!("<asset>{mesh}{field}</asset>"), ball));
    let pair = r#"<pair name="n" geom1="a" geom2="b"/>"#;
    let exclude = r#"<exclude name="n" body1="a" body2="world"/>"#;
    let joint = r#"<joint name="n" joint1="a"/>"#;
    let class = r#"<default class="n"/>"#;
    read(&text(
        &format!("<contact>{pair}{exclude}</contact><equality>{joint}</equality>"),
        ball,
    ));
    for (kind, sections, world) in [
        ("mesh", format!("<asset>{mesh}{mesh}</asset>"), ""),
        (
            "mesh",
            format!(r#"<asset>{mesh}<mesh file="n.stl"/></asset>"#),
            "",
        ),
        (
            "hfield",
            format!("<asset>{field}</asset><asset>{field}</asset>"),
            "",
        ),
        ("pair", format!("<contact>{pair}{pair}</contact>"), ""),
        (
            "exclude",
            format!("<contact>{exclude}{exclude}</contact>"),
            "",
        ),
        (
            "equality",
            format!("<equality>{joint}{joint}</equality>"),
            "",
        ),
        ("class", format!("<default>{class}{class}</default>"), ""),
        (
            "class",
            format!("<default>{class}</default><default>{class}</default>"),
            "",
        ),
        ("geom", String::new(), &*ball.repeat(2)),
        (
            "geom",
            String::new(),
            r#"<geom name="n1" size="1"/><replicate count="2"><geom name="n" size="1"/></replicate>"#,
        ),
        ("body", String::new(), r#"<body name="n"/><body name="n"/>"#),
        (
            "joint",
            String::new(),
            r#"<body><joint name="n"/><joint name="n"/></body>"#,
        ),
    ] {
        let message = refusal(&text(&sections, world));
        let expected = format!("there are several elements `{kind}` with the name `n");
        assert!(message.starts_with(&expected), "{message}");
    }
    // The outermost class has one name, and `main` is a class.
    let message = refusal(&text(r#"<default class="a"/><default class="b"/>"#, ""));
    assert!(message.starts_with("class=\"b\""), "{message}");
    let inner = r#"<default><default class="main"/></default>"#;
    assert!(refusal(&text(inner, "")).contains("class` with the name `main`"));
    read(&text(
        r#"<default class="main"><geom/></default><default><geom/></default>"#,
        "",
    ));
}

#[test]
fn includes_have_nothing_in_them_and_occur_once() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("part.xml"), "<x><geom size='1'/></x>").unwrap();
    let error = |include: &str| {
        let text = format!("<mujoco><worldbody>{include}</worldbody></mujoco>");
        let file = RobotFile::from_text(text, folder.path().join("model.xml"));
        file.read().err().map(|error| error.to_string())
    };
    let include = "<include file='part.xml'/>";
    assert_eq!(error(include), None);
    let message = error(&include.repeat(2)).unwrap();
    assert_eq!(
        message,
        "there are several elements `include` with the name `part.xml`"
    );
    let message = error("<include file='part.xml'><geom size='1'/></include>").unwrap();
    assert_eq!(message, "element `geom` in `include` is not supported");
    let message = error("<include file='part.xml' prefix='a'/>").unwrap();
    assert_eq!(message, "an element `include` has no attribute `prefix`");
}

#[test]
fn names_with_prefixes_are_refused() {
    let text = |body: &str, geom: &str| {
        format!(
            r#"<mujoco xmlns="y" xmlns:x="x"><worldbody><body pos="1 2 3" {body}>{geom}</body></worldbody></mujoco>"#
        )
    };
    read(&text("", r#"<geom size="1"/>"#));
    let message = refusal(&text("", r#"<x:geom size="1"/>"#));
    assert_eq!(message, "element `x:geom` in `body` is not supported");
    let message = refusal(&text(r#"x:pos="0 0 0""#, ""));
    assert_eq!(message, "an element `body` has no attribute `x:pos`");
}

/// Tests that a geom has either a pose or `fromto`, and that its type supports `fromto`.
#[test]
fn geoms_between_points_have_no_other_place() {
    let points = r#"size=".1 .1 .1" fromto="0 0 0 0 0 1""#;
    let geom = |own: &str, of_class: &str| {
        slide(
            "",
            &format!(r#"{points} class="m" {own}"#),
            &class(of_class),
        )
    };
    let capsule = r#"type="capsule""#;
    read(&geom(capsule, r#"<geom euler="9 9 9"/>"#));
    read(&geom(&format!(r#"{capsule} pos="0 0 0""#), "<geom/>"));
    for (own, of_class, expected) in [
        (r#"type="capsule" pos="1 0 0""#, "<geom/>", "pos=\"1 0 0\""),
        (capsule, r#"<geom pos="1 0 0"/>"#, "pos=\"1 0 0\""),
        (r#"type="sphere""#, "<geom/>", "fromto"),
        (r#"type="plane""#, "<geom/>", "fromto"),
        (r#"type="mesh" mesh="m""#, "<geom/>", "fromto"),
    ] {
        let message = refusal(&geom(own, of_class));
        assert!(
            message.contains(expected) && message.ends_with("is not valid"),
            "{message}"
        );
    }
}

/// Tests that the note on hollows names only meshes that are not convex, and no height fields.
#[test]
fn meshes_with_hollows_are_noted() {
    let convex = format!(r#"<mesh name="m" {TETRAHEDRON}/>"#);
    let open = r#"<mesh name="m" vertex="0 0 0 1 0 0 0 1 0 0 0 1" face="0 2 1 0 1 3"/>"#;
    let field = r#"<hfield name="f" nrow="2" ncol="2" size="1 1 1 1" elevation="0 1 1 0"/>"#;
    let geom = r#"type="mesh" mesh="m"/><geom type="hfield" hfield="f""#;
    for (mesh, expected) in [(&*convex, 0), (open, 1)] {
        let text = slide("", geom, &format!("<asset>{mesh}{field}</asset>"));
        let exact = read(&text);
        let message: Vec<String> = exact
            .file_remarks()
            .iter()
            .map(ToString::to_string)
            .collect();
        assert_eq!(message.len(), expected, "{message:?}");
        assert!(
            message
                .iter()
                .all(|own| own.ends_with("uses their convex hulls: m")),
            "{message:?}"
        );
        assert!(!exact.file_remarks().iter().any(CellRemark::is_warning));
        let hull = file_of(&text)
            .with_mesh_conversion(MeshConversion::OuterHull)
            .read()
            .unwrap();
        assert_eq!(hull.file_remarks(), []);
    }
}
