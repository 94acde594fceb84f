// The command line alone, where there is no editor: the verbs that need no window.
#include "cli/program.h"
#include "cli/verbs.h"
#include "slipface/base/system.h"

int main(int argument_count, char** arguments) {
    using namespace slipface;
    return cli::run_program({.name = "slipface",
                             .description = "Slipface: movement lab for 3D platformers, without the editor",
                             .footer = cli::exit_codes_help,
                             .add = cli::add_data_verbs,
                             .without_verb = {}},
                            begin_program(argument_count, arguments));
}
