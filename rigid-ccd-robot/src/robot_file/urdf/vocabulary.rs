//! The known elements and attributes of URDF, including extensions by other programs.

/// The attributes and children that an element may have.
pub(super) struct Vocabulary {
    /// The known attributes: those that are read, and those that are unrelated to shapes, joints and pairs.
    pub(super) attributes: &'static [&'static str],
    /// The children that are read.
    children: &'static [&'static str],
    /// The children that are unrelated to shapes, joints and pairs.
    pub(super) harmless: &'static [&'static str],
    /// The children that other programs may use for shapes, joints or pairs. They are ignored with a remark.
    pub(super) left_out: &'static [&'static str],
}

/// Returns the vocabulary of an element; `None` if it is unknown in its parent. The parent of the root is the empty
/// string.
pub(super) fn vocabulary_of(parent: &str, element: &str) -> Option<&'static Vocabulary> {
    let find = |name: &str| VOCABULARY.iter().find(|(own, _)| *own == name);
    let is_child = parent.is_empty() && element == "robot"
        || find(parent).is_some_and(|(_, own)| own.children.contains(&element));
    find(element).filter(|_| is_child).map(|(_, own)| own)
}

const fn leaf(attributes: &'static [&'static str]) -> Vocabulary {
    Vocabulary {
        attributes,
        children: &[],
        harmless: &[],
        left_out: &[],
    }
}

/// The vocabulary by element name, from `urdfdom` 6 and from files of other programs.
const VOCABULARY: &[(&str, Vocabulary)] = &[
    (
        "robot",
        Vocabulary {
            attributes: &["name", "version"],
            children: &["link", "joint"],
            harmless: &[
                "gazebo",
                "material",
                "mujoco",
                "ros2_control",
                "sensor",
                "transmission",
            ],
            left_out: &["loop_joint"],
        },
    ),
    (
        "link",
        Vocabulary {
            attributes: &["name", "type"],
            children: &["collision", "visual"],
            harmless: &[
                "audio_source",
                "contact",
                "gravity",
                "inertial",
                "kinematic",
                "surface",
            ],
            left_out: &[
                "collision_checking",
                "origin",
                "self_collision_checking",
                "self_filter",
            ],
        },
    ),
    (
        "collision",
        Vocabulary {
            attributes: &["name"],
            children: &["origin", "geometry"],
            harmless: &["contact_coefficients", "material", "surface", "verbose"],
            left_out: &[],
        },
    ),
    (
        "visual",
        Vocabulary {
            attributes: &["name"],
            children: &["origin", "geometry"],
            harmless: &["material"],
            left_out: &[],
        },
    ),
    (
        "geometry",
        Vocabulary {
            attributes: &["name"],
            children: &["box", "capsule", "cylinder", "mesh", "sphere"],
            harmless: &[],
            left_out: &[],
        },
    ),
    ("box", leaf(&["size"])),
    ("capsule", leaf(&["radius", "length"])),
    ("cylinder", leaf(&["radius", "length"])),
    ("mesh", leaf(&["filename", "scale"])),
    ("sphere", leaf(&["radius"])),
    ("origin", leaf(&["xyz", "rpy", "quat_xyzw"])),
    (
        "joint",
        Vocabulary {
            attributes: &["name", "type", "dont_collapse"],
            children: &["origin", "parent", "child", "axis", "limit", "mimic"],
            harmless: &["calibration", "dynamics", "safety_controller"],
            left_out: &[],
        },
    ),
    ("parent", leaf(&["link"])),
    ("child", leaf(&["link"])),
    ("axis", leaf(&["xyz"])),
    (
        "limit",
        leaf(&[
            "lower",
            "upper",
            "effort",
            "velocity",
            "acceleration",
            "deceleration",
            "jerk",
            "command_effort",
            "current",
            "gear_velocity",
        ]),
    ),
    ("mimic", leaf(&["joint", "multiplier", "offset"])),
];
