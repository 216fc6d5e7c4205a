use super::Question;
use clap::ValueEnum;

#[test]
fn questions_have_the_names_of_the_command_line() {
    assert_eq!(Question::value_variants(), Question::ALL);
    for question in Question::ALL {
        let value = question.to_possible_value().expect("none is hidden");
        assert_eq!(value.get_name(), question.name());
    }
}
