// irk query and irk export.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "experiments/tables/database.h"
#include "experiments/tables/table.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

/// Results of a study `mine` that is written by hand.
class Queries : public testing::Test {
 protected:
  void SetUp() override {
    write("runs.csv",
          "# study: mine\nkey,method,rtol,error,detail,order\n"
          "0000000000000012,gauss_2,1e-3,0.25,\"a, b\",2\n"
          "00000000000001e5,gauss_2,1e-4,nan,,3\n"
          "00000000000000ff,radau_iia_3,1e-4,1e-7,\"said \"\"no\"\"\",4\n");
    write("orders.csv", "method,value\ngauss_2,3.5\nradau_iia_3,5\n");
  }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(folder_.path() / "mine");
    std::ofstream(folder_.path() / "mine" / name) << text;
  }
  std::string file(const std::string& name) const { return folder_.path() / name; }
  Ended query(const std::string& sql, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"query", "mine", sql, "--results", folder_.path()});
    return program(more);
  }
  Ended exported() const { return program({"export", "mine", file("mine.sqlite"), "--results", folder_.path()}); }

  TemporaryFolder folder_;
};

TEST_F(Queries, PrintRowsOfJoinedTables) {
  const Ended ended = query(
      "select method, count(*) as runs, max(error) as worst, value from runs join orders using (method) "
      "group by method order by method");
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.out, "method,runs,worst,value\ngauss_2,2,0.25,3.5\nradau_iia_3,1,1e-07,5\n");
}

// Cells of columns of hashes are never numbers: 1e5 is a key. `nan` is null, in both directions.
TEST_F(Queries, KnowNumbersTextsAndUnknownValues) {
  EXPECT_EQ(query("select key, typeof(key) as kind, error, detail from runs where rtol < 0.5e-3").out,
            "key,kind,error,detail\n"
            "00000000000001e5,text,nan,\n"
            "00000000000000ff,text,1e-07,\"said \"\"no\"\"\"\n");
  EXPECT_EQ(query("select \"order\" + 1 as next from runs where key = '00000000000001e5'").out, "next\n4\n");
  EXPECT_EQ(query("select count(*) as n from runs where error is null").out, "n\n1\n");
  EXPECT_EQ(query("select method, error, \"order\" as o, detail from runs limit 2", {"--json"}).out,
            "{\"method\":\"gauss_2\",\"error\":0.25,\"o\":2,\"detail\":\"a, b\"}\n"
            "{\"method\":\"gauss_2\",\"error\":null,\"o\":3,\"detail\":\"\"}\n");
}

TEST_F(Queries, PrintBytesThatAreNoTextAsTheyAre) {
  write("orders.csv", "method,value\ngau\xdf,1\n");
  EXPECT_EQ(query("select method from orders").out, "method\ngau\xdf\n");
  EXPECT_EQ(query("select method from orders", {"--json"}).out, "{\"method\":\"gau\xef\xbf\xbd\"}\n");
}

TEST_F(Queries, ColumnsOfOneNameAreNoJsonObject) {
  const std::string both = "select * from runs join orders on runs.method = orders.method";
  EXPECT_TRUE(query(both).out.starts_with("key,method,rtol,error,detail,order,method,value\n"));
  const Ended ended = query(both, {"--json"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.out, "");
  EXPECT_TRUE(containsAll(ended.err, {"two columns have the name 'method'", "`as`"}));
}

TEST_F(Queries, WhatIsNoQuestionIsRefused) {
  struct Wrong {
    const char* sql;
    std::vector<std::string> said;
  };
  for (const auto& [sql, said] :
       {Wrong{"select method, from runs", {"near \"from\"", "character 16", "orders, runs"}},
        Wrong{"select method from rnus", {"no such table: rnus", "the tables are orders, runs"}},
        Wrong{"select metod from runs", {"no such column: metod", "character 8"}},
        Wrong{"create table own (a)", {"create table own (a)", "only select"}},
        Wrong{"attach 'own.sqlite' as own", {"only select"}}, Wrong{"begin", {"only select"}},
        Wrong{"select 1; select 2", {"one statement"}}, Wrong{"/* nothing */", {"one statement"}}}) {
    const Ended ended = query(sql);
    EXPECT_EQ(ended.status, 2) << sql;
    EXPECT_EQ(ended.out, "") << sql;
    EXPECT_TRUE(containsAll(ended.err, said)) << ended.err;
  }
  const Ended none = program({"query", "yours", "select 1", "--results", folder_.path()});
  EXPECT_EQ(none.status, 1);
  EXPECT_TRUE(containsAll(none.err, {"no results of study 'yours'", "irk run yours"}));
}

TEST_F(Queries, DamagedTablesAreNamed) {
  write("runs.csv", "key,method\n1,gauss_2\n2\n3,gauss_3\n");
  const Ended ended = query("select count(*) from runs");
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(containsAll(ended.err, {"runs.csv:3", "1 cells", "2"}));
  write("orders.csv", "");
  EXPECT_TRUE(containsAll(query("select * from orders").err, {"orders.csv", "no line with column names"}));
}

TEST_F(Queries, ExportTakesTablesOfAnyName) {
  write("a\"b.csv", "method\ngauss_2\n");
  ASSERT_EQ(exported().status, 0);
  Database database;
  Query attach(database, "attach ?1 as mine");
  attach.bind(1, file("mine.sqlite"));
  EXPECT_FALSE(attach.next());
  Query rows(database, "select method from mine.\"a\"\"b\"");
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.text(0), "gauss_2");
}

TEST_F(Queries, ExportHoldsAllTables) {
  for (const char* when : {"new", "again"}) {
    const Ended ended = exported();
    EXPECT_EQ(ended.status, 0) << when << ended.err;
    EXPECT_TRUE(containsAll(ended.out, {"2 tables", "mine.sqlite"}));
  }
  Database database;
  Query attach(database, "attach ?1 as mine");
  attach.bind(1, file("mine.sqlite"));
  EXPECT_FALSE(attach.next());
  Query runs(database, "select * from mine.runs");
  EXPECT_EQ(runs.columns(), (std::vector<std::string>{"key", "method", "rtol", "error", "detail", "order"}));
  ASSERT_TRUE(runs.next());
  EXPECT_EQ(runs.text(0), "0000000000000012");
  EXPECT_EQ(runs.real(3), 0.25);
  EXPECT_EQ(runs.text(4), "a, b");
  EXPECT_EQ(runs.integer(5), 2);
  ASSERT_TRUE(runs.next());
  EXPECT_EQ(runs.type(3), Query::Type::kNull);
  Query orders(database, "select sum(value) from mine.orders");
  ASSERT_TRUE(orders.next());
  EXPECT_EQ(orders.real(0), 8.5);
}

TEST_F(Queries, ExportKeepsOtherFilesAndLeavesNoParts) {
  const std::string notes(200, 'n');  // longer than the header of a database
  std::ofstream(file("mine.sqlite")) << notes;
  const Ended refused = exported();
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(containsAll(refused.err, {"mine.sqlite", "no database that irk export has written"}));
  EXPECT_EQ(readInputFile(file("mine.sqlite")), notes);
  std::filesystem::remove(file("mine.sqlite"));
  ASSERT_EQ(exported().status, 0);
  const std::string before = readInputFile(file("mine.sqlite"));
  write("runs.csv", "key,method\n1,gauss_2\n2\n3,gauss_3\n");
  const Ended damaged = exported();
  EXPECT_EQ(damaged.status, 2);
  EXPECT_TRUE(containsAll(damaged.err, {"runs.csv:3"}));
  EXPECT_EQ(readInputFile(file("mine.sqlite")), before);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_.path())) ++files;
  EXPECT_EQ(files, 2u) << "the study and the database";
}

}  // namespace
}  // namespace irk
