# Tests of a time limit run alone: beside others their programs wait for the processor.
set_tests_properties(TimeLimit.HoldsOnTheLongestDataOfTheRepository TimeLimit.HoldsOnLongRuns
                     PROPERTIES RUN_SERIAL ON)
