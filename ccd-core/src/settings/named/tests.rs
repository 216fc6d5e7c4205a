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
