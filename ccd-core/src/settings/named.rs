//! The settings by name: what other languages, commands and files call them, and which questions take them.

use super::{Settings, StartPolicy};
use crate::question::Question;
use std::time::Duration;

/// A setting that callers give by its name.
///
/// ```
/// use ccd_core::{Question, Setting};
/// let names: Vec<_> = Setting::taken_by(Question::ClosestApproach).map(|setting| setting.name).collect();
/// assert_eq!(names, ["tolerance", "clearance", "budget", "deadline"]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// The name.
    pub name: &'static str,
    /// The field that has the value.
    pub field: SettingField,
    is_taken_by: fn(Question) -> bool,
}

/// The function that returns a field of [`Settings`], with a variant for each type of values.
#[derive(Clone, Copy, Debug)]
pub enum SettingField {
    /// A length, in the scene's unit.
    Length(fn(&mut Settings) -> &mut f64),
    /// A length, or none.
    OptionalLength(fn(&mut Settings) -> &mut Option<f64>),
    /// An amount of work.
    Work(fn(&mut Settings) -> &mut u64),
    /// A time on a clock, or none.
    Time(fn(&mut Settings) -> &mut Option<Duration>),
    /// What happens to bodies in contact at the start.
    StartPolicy(fn(&mut Settings) -> &mut StartPolicy),
}

impl Setting {
    /// All settings, in the order in which lists of them are shown.
    pub const ALL: [Setting; 6] = [
        Setting {
            name: "tolerance",
            field: SettingField::Length(|settings| &mut settings.tolerance),
            is_taken_by: |_| true,
        },
        Setting {
            name: "margin",
            field: SettingField::Length(|settings| &mut settings.margin),
            is_taken_by: |question| !question.is_for_a_distance(),
        },
        Setting {
            name: "clearance",
            field: SettingField::OptionalLength(|settings| &mut settings.clearance),
            is_taken_by: Question::is_for_a_distance,
        },
        Setting {
            name: "budget",
            field: SettingField::Work(|settings| &mut settings.budget),
            is_taken_by: |_| true,
        },
        Setting {
            name: "deadline",
            field: SettingField::Time(|settings| &mut settings.deadline),
            is_taken_by: |_| true,
        },
        Setting {
            name: "start",
            field: SettingField::StartPolicy(|settings| &mut settings.start_policy),
            is_taken_by: Question::has_single_contact_time,
        },
    ];

    /// Returns the setting with a name; `None` if there is none.
    pub fn from_name(name: &str) -> Option<Self> {
        let mut all = Setting::ALL.into_iter();
        all.find(|setting| setting.name == name)
    }

    /// Iterates over the settings that a question takes.
    pub fn taken_by(question: Question) -> impl Iterator<Item = Setting> {
        let all = Setting::ALL.into_iter();
        all.filter(move |setting| (setting.is_taken_by)(question))
    }
}

impl StartPolicy {
    /// Both policies.
    pub const ALL: [StartPolicy; 2] = [StartPolicy::Report, StartPolicy::Leave];

    /// Returns the name of the policy in other languages, commands and files.
    pub const fn name(self) -> &'static str {
        match self {
            StartPolicy::Report => "report",
            StartPolicy::Leave => "leave",
        }
    }

    /// Returns the policy with a name; `None` if there is none.
    pub fn from_name(name: &str) -> Option<Self> {
        let mut all = StartPolicy::ALL.into_iter();
        all.find(|policy| policy.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Writes to each field by its name, and reads it from the settings.
    #[test]
    fn each_name_is_of_its_field() {
        for setting in Setting::ALL {
            let mut settings = Settings::DEFAULT;
            match setting.field {
                SettingField::Length(of) => *of(&mut settings) = 0.25,
                SettingField::OptionalLength(of) => *of(&mut settings) = Some(0.25),
                SettingField::Work(of) => *of(&mut settings) = 7,
                SettingField::Time(of) => *of(&mut settings) = Some(Duration::from_secs(7)),
                SettingField::StartPolicy(of) => *of(&mut settings) = StartPolicy::Leave,
            }
            let is_set = match setting.name {
                "tolerance" => settings.tolerance == 0.25,
                "margin" => settings.margin == 0.25,
                "clearance" => settings.clearance == Some(0.25),
                "budget" => settings.budget == 7,
                "deadline" => settings.deadline == Some(Duration::from_secs(7)),
                "start" => settings.start_policy == StartPolicy::Leave,
                other => panic!("{other} is no setting"),
            };
            assert!(is_set, "{}", setting.name);
            assert_eq!(
                Setting::from_name(setting.name).map(|found| found.name),
                Some(setting.name)
            );
        }
        assert!(Setting::from_name("tolerence").is_none() && StartPolicy::from_name("").is_none());
        for policy in StartPolicy::ALL {
            assert_eq!(StartPolicy::from_name(policy.name()), Some(policy));
        }
    }

    #[test]
    fn questions_take_the_settings_that_matter_to_them() {
        let names = |question| {
            let taken = Setting::taken_by(question).map(|setting| setting.name);
            taken.collect::<Vec<_>>().join(" ")
        };
        let expected = [
            (
                Question::FirstContact,
                "tolerance margin budget deadline start",
            ),
            (
                Question::AnyContact,
                "tolerance margin budget deadline start",
            ),
            (
                Question::ContactInterval,
                "tolerance margin budget deadline",
            ),
            (
                Question::ClosestApproach,
                "tolerance clearance budget deadline",
            ),
            (Question::Distance, "tolerance clearance budget deadline"),
        ];
        for (question, taken) in expected {
            assert_eq!(names(question), taken, "{question}");
        }
    }
}
