//! Serialises a start policy by its name.

use rigid_ccd::StartPolicy;
use serde::de::{Deserialize, Deserializer, Error};
use serde::ser::Serializer;

// serde prescribes these signatures.
#[allow(clippy::trivially_copy_pass_by_ref)]
pub(super) fn serialize<S: Serializer>(
    policy: &StartPolicy,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(policy.name())
}

pub(super) fn deserialize<'d, D: Deserializer<'d>>(
    deserializer: D,
) -> Result<StartPolicy, D::Error> {
    let name = String::deserialize(deserializer)?;
    let unknown = || D::Error::custom(format!("`{name}` is not a start policy"));
    StartPolicy::from_name(&name).ok_or_else(unknown)
}

#[allow(clippy::trivially_copy_pass_by_ref)]
pub(super) fn is_default(policy: &StartPolicy) -> bool {
    *policy == StartPolicy::default()
}
